// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"
#include "stages/codecs.h"
#include "stages/list_pairs/plan_matching.h"
#include "stages/pipeline_options.h"
#include "stages/plans.h"
#include "stages/stage_task.h"

namespace orbweave::testing {

/// A job on the matches of a made-up street; `assignments` are options, "section.name=value".
inline JobSpec StreetJob(const CorridorOptions& corridor,
                         const std::vector<std::string>& assignments,
                         BlobAccess& blobs) {
  const Corridor street = MakeCorridor(corridor);
  std::vector<Digest> names;
  std::vector<Digest> both;
  for (const Features& features : street.features) {
    names.push_back(PutBlob(features, blobs).value());
    const PlaceSample place{.num_features = static_cast<uint32_t>(features.size())};
    both.insert(both.end(), {names.back(), PutBlob(place, blobs).value()});
  }
  std::vector<MatchRecipe::Pair> pairs;
  for (const PairMatches& pair : street.pairs) pairs.push_back({pair.pair, pair.matches});
  std::vector<Digest> recipes;
  for (const MatchRecipe& recipe : PlanMatching(std::move(pairs), names, {}, 64))
    recipes.push_back(PutBlob(recipe, blobs).value());
  PipelineOptions options;
  for (const std::string& assignment : assignments)
    EXPECT_TRUE(SetPipelineOption(options, assignment).ok()) << assignment;
  using Job = SparseFromMatchesJob;
  JobInputs<Job> inputs;
  inputs.Set(&Job::manifest, PutBlob(street.manifest, blobs).value())
      .Set(&Job::features, PutBlob(both, blobs).value())
      .Set(&Job::runs, PutBlob(recipes, blobs).value())
      .Set(&Job::clusters_by_hand, PutBlob(ClusterNames{}, blobs).value());
  return {.kind = std::string(Job::kKind),
          .inputs = inputs.InOrder(),
          .options_text = PipelineOptionsToText(options)};
}

}  // namespace orbweave::testing
