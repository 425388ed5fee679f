// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/base/random.h"
#include "core/synthetic/corridor_path.h"

namespace orbweave {

/// A scene point and which panoramas may see it: of which drives, and from how far (in the plane).
struct StreetPoint {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  bool in_tunnel = false;  ///< else it is not seen from deep in the tunnel
  bool seen_by_first = true;
  bool seen_by_second = true;

  [[nodiscard]] bool IsSeenFrom(const CorridorStation& station, const CorridorCell& cell) const {
    if (!in_tunnel && !cell.sees_street) return false;
    if (!(station.drive == 0 ? seen_by_first : seen_by_second)) return false;
    return (position_in_world.head<2>() - station.place.position).norm() >= nearest_m;
  }
};

/// A point about the middle of `cell`, `along_m` further along the street: facades on both sides,
/// ground and clutter; in a tunnel lamps and joints of its walls, which are seen ahead and behind
/// and no more when one is beside them.
[[nodiscard]] StreetPoint MakeStreetPoint(const CorridorCell& cell, double along_m, Random& random);

/// Panoramas of one drive that see a point of the street or of the tunnel, on average.
[[nodiscard]] double MeanViews(bool in_tunnel, double spacing_m);

/// Share of the panoramas within a point's range that see it.
constexpr double kSeenShare = 0.9;

}  // namespace orbweave
