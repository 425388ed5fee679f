// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/recipes.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/scene/features.h"

namespace orbweave {

/// An image of a cluster as rays: what is left of Features once pixels have done their part.
[[nodiscard]] ClusterImage ToClusterImage(ImageId id, const Features& features);

/// Moves those of `geometries` that the recipe asks for into `problem.pairs`.
void TakePairs(const ClusterRecipe& recipe,
               std::vector<TwoViewGeometry> geometries,
               ClusterProblem& problem);

/// Gives the images of a cluster, sorted, their GNSS positions.
void TakeFixes(const ClusterRecipe& recipe, ClusterProblem& problem);

}  // namespace orbweave
