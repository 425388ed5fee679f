// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fetch_pairs.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/pipeline/job_plan.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/two_view_codec.h"

namespace orbweave {
namespace {

const std::set<std::string> kMatchStages = {"match_images", "verify_matches"};

/// The recipes of all parts of the stages that match pairs.
absl::StatusOr<std::vector<Digest>> MatchRecipes(CoordinatorApi& coordinator,
                                                 const JobSpec& job,
                                                 const std::vector<TaskOutcome>& outcomes) {
  std::vector<Digest> recipes;
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  for (const StageRule& rule : plan.stages) {
    if (!kMatchStages.contains(rule.stage)) continue;
    if (rule.parts_listed_in) {
      ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes,
                                coordinator.Get(job.inputs.at(*rule.parts_listed_in)));
      ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> listed, DecodeCollection(bytes));
      recipes.insert(recipes.end(), listed.begin(), listed.end());
    }
    for (const TaskOutcome& outcome : outcomes) {
      if (outcome.stage != rule.parts_from) continue;
      recipes.insert(recipes.end(), outcome.result.recipes.begin(), outcome.result.recipes.end());
    }
  }
  return recipes;
}

}  // namespace

absl::StatusOr<JobPairs> FetchPairs(CoordinatorApi& coordinator,
                                    const JobSpec& job,
                                    const std::vector<TaskOutcome>& outcomes,
                                    const std::function<bool(const ImagePair&)>& wanted) {
  JobPairs pairs;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> recipes,
                            MatchRecipes(coordinator, job, outcomes));
  for (const Digest& digest : recipes) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(digest));
    ORBWEAVE_ASSIGN_OR_RETURN(MatchRecipe recipe, DecodeMatchRecipe(bytes));
    for (MatchRecipe::Pair& pair : recipe.pairs) {
      if (wanted(pair.pair)) pairs.tried.push_back(std::move(pair));
    }
  }
  for (const TaskOutcome& outcome : outcomes) {
    if (!kMatchStages.contains(outcome.stage) || outcome.result.outputs.empty()) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes,
                              coordinator.Get(outcome.result.outputs.front()));
    ORBWEAVE_ASSIGN_OR_RETURN(std::vector<TwoViewGeometry> part, DecodeTwoViewGeometries(bytes));
    for (TwoViewGeometry& geometry : part) {
      if (wanted(geometry.pair)) pairs.verified.push_back(std::move(geometry));
    }
  }
  std::ranges::sort(pairs.tried, {}, &MatchRecipe::Pair::pair);
  std::ranges::sort(pairs.verified, {}, &TwoViewGeometry::pair);
  return pairs;
}

}  // namespace orbweave
