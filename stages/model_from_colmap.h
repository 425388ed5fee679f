// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/io/colmap/colmap_model.h"
#include "core/merging/finalise_adjustment.h"
#include "core/partitioned_ba/subproblem.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// A model of another program as our own stages leave one.
struct ImportedModel {
  FinalisedWorld world{};
  std::vector<Subproblem> subproblems{};   ///< up to 100 images each, by id
  std::vector<Exclusion> without_image{};  ///< images of the model that the folder does not have
};

/// Matches names by MatchNames. Poses that are not finite count as absent. Bearings are those of
/// the points themselves. InvalidArgument: no image of the model is in the manifest (names some of
/// both).
[[nodiscard]] absl::StatusOr<ImportedModel> ModelFromColmap(const ColmapModel& model,
                                                            const ImageManifest& manifest);

}  // namespace orbweave
