// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace orbweave {

/// Where a surface is to be judged: what enough panoramas see from near.
struct SurfaceRegion {
  std::vector<Eigen::Vector3d> centres{};  ///< of the cameras, in the frame of the points
  double min_range_m = 2.0;
  double max_range_m = 15.0;
  int min_views = 2;
  /// Distance of neighbouring samples of the surface: what lies behind it is not seen. 0: the
  /// surface hides nothing.
  double sample_spacing_m = 0.0;
};

/// Per point, how many centres (up to 255) lie within the region's ranges of it.
[[nodiscard]] std::vector<uint8_t> CountInReach(std::span<const Eigen::Vector3d> points,
                                                const SurfaceRegion& region);

/// Per point, how many of these centres (up to 255) see it past the other points. Each sample
/// covers a square of 1.5 spacings that faces the camera; a point is hidden where one covers it
/// that is nearer by more than 8 spacings: a plane seen at 6 degrees or more does not hide itself.
/// Samples nearer than a spacing hide nothing. Time: cameras x points.
[[nodiscard]] std::vector<uint8_t> CountObservers(std::span<const Eigen::Vector3d> points,
                                                  const SurfaceRegion& region);

}  // namespace orbweave
