// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/surface_point.h"

namespace orbweave {

/// A cloud from above, as seen with `right` to the right and `ahead` to the top.
struct TopPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<uint8_t> rgba{};  ///< row-major from the top; alpha 0 where no point lies, else 255
  double pixel = 0.0;           ///< edge of a pixel, in units of the world
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitY();
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< upper left one, along `right` and `ahead`
};

/// Looks at a cloud from above while its points go by: in each pixel the highest one is seen, of
/// several the one of larger colour. Pixels double their edge whenever the picture would get too
/// large, so memory depends on `max_side_px` alone; which point is seen depends neither on how
/// often they did nor on the order of points.
class TopView {
 public:
  /// `up`: unit; where it is the world's z, x runs to the right and y to the top. `pixel`: edge of
  /// the smallest pixel, positive.
  TopView(const Eigen::Vector3d& up, double pixel, int max_side_px);

  void Add(std::span<const SurfacePoint> points);

  /// As small as holds all points; empty without any.
  [[nodiscard]] TopPicture Picture() const;

 private:
  struct Cell {
    float height = 0.0F;
    Rgb color{};
    bool seen = false;
  };
  /// Pixels of the plane, both ends included.
  struct Extent {
    int64_t left = 0;
    int64_t right = -1;
    int64_t low = 0;
    int64_t high = -1;

    [[nodiscard]] bool IsEmpty() const { return right < left; }
    [[nodiscard]] int64_t Width() const { return right - left + 1; }
    [[nodiscard]] int64_t Height() const { return high - low + 1; }
  };

  [[nodiscard]] static Extent Union(const Extent& a, const Extent& b);
  [[nodiscard]] static Extent Halved(const Extent& extent);
  [[nodiscard]] Extent ExtentOf(std::span<const SurfacePoint> points) const;
  [[nodiscard]] int64_t PixelOf(const SurfacePoint& point, const Eigen::Vector3d& axis) const;
  [[nodiscard]] Cell& At(int64_t column, int64_t row);
  void Show(int64_t column, int64_t row, const Cell& cell);
  void Rebuild(const Extent& held, int shift);

  Eigen::Vector3d right_;
  Eigen::Vector3d ahead_;
  Eigen::Vector3d up_;
  double pixel_;
  int64_t max_side_px_;
  Extent used_{};
  Extent held_{};  ///< by cells_; more than what is used, so that it seldom grows
  std::vector<Cell> cells_{};
};

}  // namespace orbweave
