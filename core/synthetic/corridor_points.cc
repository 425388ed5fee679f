// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kMinRangeM = 6.0;  // along the street
constexpr double kMaxRangeM = 14.0;
constexpr double kTunnelNearestM = 8.0;
constexpr double kTunnelFarthestM = 26.0;
constexpr double kTunnelRadiusM = 4.0;

Eigen::Vector3d InWorld(const CorridorCell& cell, double along_m, double lateral_m, double height) {
  const Eigen::Vector2d ground =
      cell.place.position + along_m * cell.place.direction + lateral_m * cell.place.Left();
  return {ground.x(), ground.y(), height};
}

StreetPoint MakeTunnelPoint(const CorridorCell& cell, double along_m, Random& random) {
  const double angle = random.Uniform(0.0, std::numbers::pi);
  return {
      .position_in_world = InWorld(
          cell, along_m, kTunnelRadiusM * std::cos(angle), 1.0 + kTunnelRadiusM * std::sin(angle)),
      .nearest_m = kTunnelNearestM,
      .farthest_m = kTunnelFarthestM,
      .in_tunnel = true};
}

}  // namespace

StreetPoint MakeStreetPoint(const CorridorCell& cell, double along_m, Random& random) {
  if (cell.in_tunnel) return MakeTunnelPoint(cell, along_m, random);
  const double kind = random.Uniform();
  const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
  double lateral_m = side * random.Uniform(8.0, 15.0);
  double height_m = random.Uniform(0.0, 15.0);
  if (kind > 0.85) {  // clutter: parked cars, poles, signs
    lateral_m = side * random.Uniform(3.0, 8.0);
    height_m = random.Uniform(0.0, 3.0);
  } else if (kind > 0.75) {  // ground
    lateral_m = side * random.Uniform(1.5, 8.0);
    height_m = 0.0;
  }
  const double range_m = std::hypot(lateral_m, random.Uniform(kMinRangeM, kMaxRangeM));
  return {.position_in_world = InWorld(cell, along_m, lateral_m, height_m), .farthest_m = range_m};
}

double MeanViews(bool in_tunnel, double spacing_m) {
  const double metres = in_tunnel ? 2.0 * (kTunnelFarthestM - kTunnelNearestM)
                                  : kMinRangeM + kMaxRangeM;  // twice the mean range
  return std::max(1.0, kSeenShare * metres / spacing_m);
}

}  // namespace orbweave
