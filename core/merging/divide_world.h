// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/merging/georeference/georeference.h"
#include "core/partitioned_ba/subproblem.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Drops what loose and missing images saw, and tracks that are then seen once.
void DropLooseObservations(Reconstruction& scene);

/// Divides a world among the clusters that own its images (`owners` names one for each), in order
/// of clusters; one that owns nothing has no subproblem. Tracks that one owner's images see are
/// that owner's; AssignTracks decides about the others. GNSS priors (AddGnss) go to the owner of
/// their image when the world is georeferenced; otherwise a gauge is chosen: the first image is
/// held, and its distance from the one farthest away kept. Observations of loose images are left
/// out.
[[nodiscard]] std::vector<Subproblem> DivideWorld(Reconstruction scene,
                                                  uint32_t world,
                                                  const std::map<ImageId, uint32_t>& owners,
                                                  const Georeference& georeference,
                                                  const ImageManifest& manifest,
                                                  double bias_sigma_m);

}  // namespace orbweave
