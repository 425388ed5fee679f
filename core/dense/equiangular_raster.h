// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace orbweave {

/// The raster of depth maps: six faces of a cube (cube_face.h) of face_px x face_px pixels that are
/// equal angles along both axes of a face,
///
///   x / z = tan(pi/4 (2 column / face_px - 1)),   y / z = tan(pi/4 (2 row / face_px - 1)),
///
/// in the face's frame. Positions are in pixels, (0, 0) the corner of the first, its middle at
/// (0.5, 0.5). With face_px = W / 4 nothing of a panorama of width W is lost at its equator, at
/// 0.75 of its pixels.
struct EquiangularRaster {
  int face_px = 0;

  /// A position; beyond [0, face_px] it runs on over the face's edge.
  struct Place {
    int face = 0;
    double row = 0.0;
    double column = 0.0;
  };

  /// Unit bearing in the camera frame.
  [[nodiscard]] Eigen::Vector3d BearingFromPixel(int face, double row, double column) const;
  /// Where a non-zero vector of the camera frame lies: on the face nearest to it (FaceOf).
  [[nodiscard]] Place PixelFromBearing(const Eigen::Vector3d& bearing) const;

  [[nodiscard]] size_t NumPixels() const {
    return 6 * static_cast<size_t>(face_px) * static_cast<size_t>(face_px);
  }
  [[nodiscard]] size_t Index(int face, int row, int column) const {
    const auto size = static_cast<size_t>(face_px);
    return (static_cast<size_t>(face) * size + static_cast<size_t>(row)) * size +
           static_cast<size_t>(column);
  }
  /// Index of the pixel that a place with row and column in [0, face_px] lies in.
  [[nodiscard]] size_t Index(const Place& place) const;
  /// Angle of a pixel along an axis of its face; radians.
  [[nodiscard]] double PixelAngle() const;
};

}  // namespace orbweave
