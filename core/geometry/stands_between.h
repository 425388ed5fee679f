// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace orbweave {

/// What a point sees of two cameras: how far apart they are, and how far away the farther one is.
struct TwoFromPoint {
  double apart_rad = 0.0;
  double farther = 0.0;
};

/// As far away from the point a camera between two others is, at most, as the farther one.
inline constexpr double kMaxFartherBetween = 1.05;

/// Whether a camera stands between the two: with the angles at the point, X between the two, A and
/// C from the camera to each of them, A + C <= 1.05 X + 0.01 rad, X >= 0.05 rad, A, C >= X / 5, and
/// no further away than the farther of both, to a twentieth. What both see it should see, unless
/// something stands in the way.
[[nodiscard]] inline bool StandsBetween(const TwoFromPoint& two,
                                        double to_one_rad,
                                        double to_other_rad,
                                        double distance) {
  return two.apart_rad >= 0.05 && to_one_rad + to_other_rad <= 1.05 * two.apart_rad + 0.01 &&
         std::min(to_one_rad, to_other_rad) >= 0.2 * two.apart_rad &&
         distance <= kMaxFartherBetween * two.farther;
}

}  // namespace orbweave
