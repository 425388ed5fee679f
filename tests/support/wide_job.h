// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/blob_access.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/job_plan.h"

/// A job of one stage with as many parts as one likes, which read nothing.

namespace orbweave::testing {

inline absl::StatusOr<JobPlan> FindWidePlan(std::string_view) {
  return JobPlan{"wide",
                 {{.stage = "part",
                   .version = "1",
                   .parts_listed_in = 0,
                   .inputs = {{InputRule::Kind::kRecipe, "", 0}}}}};
}

/// The recipes of parts number `first` and on; of every number there is one in the world.
inline std::vector<Digest> WideRecipes(uint64_t first, size_t parts) {
  std::vector<Digest> recipes;
  for (size_t i = 0; i < parts; ++i) recipes.push_back(DigestOf(std::to_string(first + i)));
  return recipes;
}

inline absl::StatusOr<JobSpec> PrepareWideJob(BlobAccess& blobs,
                                              const std::vector<Digest>& recipes) {
  JobSpec job{.kind = "wide", .label = std::to_string(recipes.size()) + " parts"};
  ORBWEAVE_ASSIGN_OR_RETURN(job.inputs.emplace_back(), blobs.Put(EncodeCollection(recipes)));
  return job;
}

}  // namespace orbweave::testing
