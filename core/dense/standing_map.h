// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <tuple>
#include <vector>

#include "core/dense/posed_depth_map.h"
#include "core/dense/raster_bearings.h"

namespace orbweave {

/// Smaller ranks higher: class of sigma, image, pixel.
using PixelRank = std::tuple<int, ImageId, size_t>;

/// A pixel that was checked, in the axes of its StandingMap.
struct PixelSample {
  Eigen::Vector3d ray = Eigen::Vector3d::Zero();  ///< unit, from its own camera
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;
  PixelRank rank{};
};

/// A depth map in the axes of the world, about an origin near its camera. It must not be empty, its
/// pose finite; the map outlives the object.
class StandingMap {
 public:
  StandingMap(const PosedDepthMap& posed, const Eigen::Vector3d& origin);

  [[nodiscard]] bool IsChecked(size_t pixel) const;
  [[nodiscard]] PixelSample SampleOf(size_t pixel) const;
  /// Pixels with rays near a unit vector (RasterBearings::Around).
  void Around(const Eigen::Vector3d& direction, double limit_px, std::vector<size_t>& pixels) const;
  /// What a pixel covers of a surface that faces it: range x angle of a pixel.
  [[nodiscard]] double Footprint(const Eigen::Vector3d& point) const;
  [[nodiscard]] double PixelAngle() const { return bearings_.raster().PixelAngle(); }
  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] ImageId image() const { return image_; }
  [[nodiscard]] const DepthMap& map() const { return *map_; }
  [[nodiscard]] const RasterBearings& bearings() const { return bearings_; }

 private:
  ImageId image_;
  const DepthMap* map_;
  RasterBearings bearings_;
  Eigen::Matrix3d world_from_cam_;
  Eigen::Vector3d centre_;
};

}  // namespace orbweave
