// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// Faces of the cube about a panorama, in this order: 0 front (+z), 1 right (+x), 2 back (-z),
/// 3 left (-x), 4 up (-y), 5 down (+y); axes of the camera as of `EquirectangularCamera`: x right,
/// y down, z forward. The upper edge of the front face is the lower edge of the upper one, and so
/// below: both show what one sees who tilts the head from the front.
inline constexpr int kCubeFaces = 6;

/// R_PS of equation (12): turns a vector of the camera frame into the frame of a face (x right, y
/// down, z out of the face). A proper rotation of zeros and ones; face in [0, 6).
[[nodiscard]] const Eigen::Matrix3d& FaceFromCamera(int face);

/// The face whose axis is nearest to a vector (of any length), ties by the smaller index: each
/// direction has exactly one. Zero and not-a-number belong to face 0.
[[nodiscard]] int FaceOf(const Eigen::Vector3d& bearing_in_cam);

/// Equation (12): R_P = R_PS R, T_P = -R_P C. The pose of a face; the centre stays.
[[nodiscard]] Rigid3 FaceFromWorld(int face, const Rigid3& cam_from_world);

/// The square pinhole camera of 90 degrees that just covers a face: focal length and principal
/// point are size / 2. Pixel (0, 0) is the corner of the first pixel, its middle is (0.5, 0.5).
struct PinholeFace {
  int size_px = 0;

  friend bool operator==(const PinholeFace&, const PinholeFace&) = default;

  [[nodiscard]] double Focal_px() const { return 0.5 * size_px; }
  [[nodiscard]] double Principal_px() const { return 0.5 * size_px; }
  /// Unit bearing in the face's frame of a pixel position, which may lie beyond the face.
  [[nodiscard]] Eigen::Vector3d BearingFromPixel(const Eigen::Vector2d& pixel) const;
  /// Pixel position of a vector in the face's frame with z > 0; within [0, size]^2 when the vector
  /// belongs to the face. What has z <= 0 is not before the face: its answer means nothing.
  [[nodiscard]] Eigen::Vector2d PixelFromBearing(const Eigen::Vector3d& bearing_in_face) const;
};

}  // namespace orbweave
