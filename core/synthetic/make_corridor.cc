// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/make_corridor.h"

#include "core/synthetic/corridor_cameras.h"
#include "core/synthetic/corridor_matches.h"
#include "core/synthetic/corridor_observations.h"
#include "core/synthetic/corridor_path.h"
#include "core/synthetic/planar_grid.h"

namespace orbweave {

Corridor MakeCorridor(const CorridorOptions& options) {
  const CorridorPath path = MakeCorridorPath(options);
  std::vector<Eigen::Vector2d> positions;
  for (const CorridorStation& station : path.stations) positions.push_back(station.place.position);
  const PlanarGrid cameras(positions, kMeetingRadiusM);
  Corridor corridor;
  MakeCameras(options, path, corridor);
  MakePointsAndFeatures(options, path, cameras, corridor);
  MakePairs(options, path, cameras, corridor);
  return corridor;
}

}  // namespace orbweave
