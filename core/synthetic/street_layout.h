// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/synthetic/street_path.h"

namespace orbweave {

/// Distances from the lane's axis in metres, positive to the left. Driving clockwise, the block
/// lies on the right; the other lane, parked cars and the outer houses on the left.
struct StreetProfile {
  static constexpr double kInnerFacade_m = -6.0;
  static constexpr double kInnerKerb_m = -2.8;
  static constexpr double kLaneMark_m = 1.7;
  static constexpr double kOncomingLane_m = 2.6;
  static constexpr double kParkedCars_m = 4.5;
  static constexpr double kOuterKerb_m = 5.5;
  static constexpr double kOuterFacade_m = 9.0;
};

/// Height of the ground in the street's frame: cameras drive about z = 0.
constexpr double kStreetGround_m = -2.5;

/// A street round a rectangular block. The street's frame: origin in the middle of the block, x
/// along its longer side (east), y north, z up, metres.
struct StreetLayout {
  Eigen::Vector2d half_m;  ///< of the rectangle that the lane's axis follows
  StreetPath axis;         ///< clockwise seen from above, corners rounded

  /// Signed distance of a place from the lane's axis, positive outside the loop.
  [[nodiscard]] double DistanceFromAxis(const Eigen::Vector2d& place) const;
};

/// The axis is `length_m` long, but at least 110 m.
[[nodiscard]] StreetLayout MakeStreetLayout(double length_m);

}  // namespace orbweave
