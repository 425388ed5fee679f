// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct_cluster/assemble_cluster.h"

#include <algorithm>

#include "core/scene/features.h"

namespace orbweave {

ClusterImage ToClusterImage(ImageId id, const Features& features) {
  return {.id = id,
          .camera = features.camera,
          .bearings = BearingsOf(features),
          .sigma_rad = features.sigma_rad,
          .colors = features.colors};
}

void TakePairs(const ClusterRecipe& recipe,
               std::vector<TwoViewGeometry> geometries,
               ClusterProblem& problem) {
  for (TwoViewGeometry& geometry : geometries) {
    if (std::binary_search(recipe.pairs.begin(), recipe.pairs.end(), geometry.pair)) {
      problem.pairs.push_back(std::move(geometry));
    }
  }
  std::sort(problem.pairs.begin(), problem.pairs.end(), [](const auto& x, const auto& y) {
    return x.pair < y.pair;
  });
}

void TakeFixes(const ClusterRecipe& recipe, ClusterProblem& problem) {
  for (const PositionFix& fix : recipe.fixes) {
    const auto image = std::ranges::lower_bound(problem.images, fix.image, {}, &ClusterImage::id);
    if (image == problem.images.end() || image->id != fix.image) continue;
    image->prior.position_in_enu = fix.position_in_enu;
    image->prior.horizontal_sigma_m = fix.horizontal_sigma_m;
    image->prior.vertical_sigma_m = fix.vertical_sigma_m;
    image->is_position_of_drive = fix.is_of_drive;
  }
}

}  // namespace orbweave
