// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "core/artifacts/recipes.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_api.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Pairs of a job: those that were to be tried, each once, with matches that came from outside, and
/// those of them that have a geometry; both sorted. Of a pair that was matched again the second
/// time counts.
struct JobPairs {
  std::vector<MatchRecipe::Pair> tried{};
  std::vector<TwoViewGeometry> verified{};
};

/// The pairs of which `wanted` is true; one blob is open at a time. Without results of the stages
/// that choose and match pairs: none.
[[nodiscard]] absl::StatusOr<JobPairs> FetchPairs(
    BlobAccess& coordinator,
    const JobSpec& job,
    const std::vector<TaskOutcome>& outcomes,
    const std::function<bool(const ImagePair&)>& wanted);

}  // namespace orbweave
