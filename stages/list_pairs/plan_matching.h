// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/artifacts/recipes.h"

namespace orbweave {

/// Cuts sorted pairs into runs of `pairs_per_task`; neighbours in order share images, so a run
/// opens few Features. `features[id]` is the blob of each image. A run gets of the carriers what
/// concerns its images.
[[nodiscard]] std::vector<MatchRecipe> PlanMatching(std::vector<MatchRecipe::Pair> pairs,
                                                    const std::vector<Digest>& features,
                                                    std::span<const Carrier> carriers,
                                                    size_t pairs_per_task);

}  // namespace orbweave
