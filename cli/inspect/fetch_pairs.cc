// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/fetch_pairs.h"

#include <algorithm>
#include <utility>

#include "stages/codecs.h"
#include "stages/job_reader.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

/// What is matched again comes last.
void KeepLastOfEach(std::vector<MatchRecipe::Pair>& tried) {
  std::ranges::reverse(tried);
  std::ranges::stable_sort(tried, {}, &MatchRecipe::Pair::pair);
  const auto rest = std::ranges::unique(tried, {}, &MatchRecipe::Pair::pair);
  tried.erase(rest.begin(), rest.end());
}

}  // namespace

absl::StatusOr<JobPairs> FetchPairs(BlobAccess& coordinator,
                                    const JobSpec& job,
                                    const std::vector<TaskOutcome>& outcomes,
                                    const std::function<bool(const ImagePair&)>& wanted) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader reader(plan, job, outcomes, coordinator);
  JobPairs pairs;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> recipes,
                            reader.RecipesBehind(&PartitionViewGraphStage::verified));
  for (const Digest& digest : recipes) {
    ORBWEAVE_ASSIGN_OR_RETURN(MatchRecipe recipe, reader.Fetch<MatchRecipe>(digest));
    for (MatchRecipe::Pair& pair : recipe.pairs) {
      if (wanted(pair.pair)) pairs.tried.push_back(std::move(pair));
    }
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> verified,
                            reader.List(&PartitionViewGraphStage::verified));
  for (const Digest& digest : verified) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto part, reader.Fetch<std::vector<TwoViewGeometry>>(digest));
    for (TwoViewGeometry& geometry : part) {
      if (wanted(geometry.pair)) pairs.verified.push_back(std::move(geometry));
    }
  }
  KeepLastOfEach(pairs.tried);
  std::ranges::sort(pairs.verified, {}, &TwoViewGeometry::pair);
  return pairs;
}

}  // namespace orbweave
