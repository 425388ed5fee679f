// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/assemble_cluster.h"

#include <algorithm>

#include "core/stages/match_image_pair.h"

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

std::vector<ImageRays> RaysOf(const ClusterProblem& problem) {
  std::vector<ImageRays> rays;
  for (const ClusterImage& image : problem.images)
    rays.push_back({image.id, image.bearings, image.sigma_rad});
  return rays;
}

}  // namespace orbweave
