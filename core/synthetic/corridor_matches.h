// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/corridor.h"
#include "core/synthetic/corridor_path.h"
#include "core/synthetic/planar_grid.h"

namespace orbweave {

/// Panoramas this close are matched wherever they are in the sequence.
constexpr double kMeetingRadiusM = 20.0;

/// Fills `corridor.pairs`: features of the same points; features of copies where the point itself
/// is not seen; wrong matches among them. Needs MakePointsAndFeatures; `cameras` holds the places
/// of the panoramas.
void MakePairs(const CorridorOptions& options,
               const CorridorPath& path,
               const PlanarGrid& cameras,
               Corridor& corridor);

}  // namespace orbweave
