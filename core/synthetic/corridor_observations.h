// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/corridor.h"
#include "core/synthetic/corridor_path.h"
#include "core/synthetic/planar_grid.h"

namespace orbweave {

/// Points cell by cell along the street, each with the features that show it in the panoramas of
/// `corridor`; then the carrier's roof in every panorama. Needs MakeCameras; `cameras` holds the
/// places of its panoramas.
void MakePointsAndFeatures(const CorridorOptions& options,
                           const CorridorPath& path,
                           const PlanarGrid& cameras,
                           Corridor& corridor);

}  // namespace orbweave
