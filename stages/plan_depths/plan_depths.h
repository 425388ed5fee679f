// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/dense_records.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Turns the choices of all subproblems, one after the other, into recipes for depth maps. Only
/// models in one frame are dense together: the first, and those that stand on earth with it.
class DepthPlanner {
 public:
  /// What it is given outlives it. Pictures wider than `max_width_px` are to be reduced.
  DepthPlanner(const ImageManifest& manifest, const FinalisedModel& model, int max_width_px);

  /// Recipes of the next subproblem's panoramas, for the next entries of DensePlan::panoramas.
  /// InvalidArgument: an image that the manifest does not have.
  [[nodiscard]] absl::StatusOr<std::vector<DepthRecipe>> Plan(const ChosenSources& chosen);

  /// After all: also names every image without depth, with the reason.
  [[nodiscard]] DensePlan Finish() &&;

 private:
  [[nodiscard]] PanoramaFile FileOf(ImageId image) const;
  [[nodiscard]] DepthRecipe RecipeOf(const SourceChoice& choice, double unit_m) const;

  const ImageManifest& manifest_;
  int max_width_px_;
  std::map<ImageId, Rigid3> poses_;         ///< cam_from_model of all panoramas in the frame
  std::map<ImageId, std::string> reasons_;  ///< of images without depth
  DensePlan plan_;
};

}  // namespace orbweave
