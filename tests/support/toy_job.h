// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/match.h"
#include "core/pipeline/coordinator_api.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/stage_function.h"

/// A job small enough to follow by hand: "1 2 3" is split into numbers, each is squared by a task
/// of its own, and the squares are summed: "14".

namespace orbweave::testing {

inline JobPlan ToyPlan() {
  using Kind = InputRule::Kind;
  return {"toy",
          {{.stage = "split", .version = "1", .inputs = {{Kind::kJobInput, "", 0}}},
           {.stage = "square",
            .version = "1",
            .parts_from = "split",
            .inputs = {{Kind::kRecipe, "", 0}},
            .option_sections = {"toy"}},
           {.stage = "sum", .version = "1", .inputs = {{Kind::kCollection, "square", 0}}}}};
}

inline absl::StatusOr<JobPlan> FindToyPlan(std::string_view kind) {
  if (kind == "toy") return ToyPlan();
  return absl::NotFoundError("there is no job kind '" + std::string(kind) + "'");
}

inline absl::StatusOr<TaskResult> Split(const TaskSpec& spec,
                                        BlobAccess& blobs,
                                        const StageContext&) {
  TaskResult result;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, blobs.Get(spec.inputs.at(0)));
  std::istringstream numbers(text);
  for (std::string number; numbers >> number;) {
    ORBWEAVE_ASSIGN_OR_RETURN(result.recipes.emplace_back(), blobs.Put(number));
  }
  return result;
}

/// "toy.slow=true" makes it take until it is told to stop; "toy.pause=true" makes it take 0.2 s.
inline absl::StatusOr<TaskResult> Square(const TaskSpec& spec,
                                         BlobAccess& blobs,
                                         const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string number, blobs.Get(spec.inputs.at(0)));
  context.Report(1, 2, "numbers");
  if (absl::StrContains(spec.options_text, "toy.pause=true")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  while (absl::StrContains(spec.options_text, "toy.slow=true")) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const int64_t value = std::stoll(number);
  TaskResult result;
  ORBWEAVE_ASSIGN_OR_RETURN(result.outputs.emplace_back(),
                            blobs.Put(std::to_string(value * value)));
  return result;
}

inline absl::StatusOr<TaskResult> Sum(const TaskSpec& spec,
                                      BlobAccess& blobs,
                                      const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string list, blobs.Get(spec.inputs.at(0)));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> squares, DecodeCollection(list));
  int64_t sum = 0;
  for (const Digest& square : squares) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, blobs.Get(square));
    sum += std::stoll(text);
  }
  TaskResult result;
  ORBWEAVE_ASSIGN_OR_RETURN(result.outputs.emplace_back(), blobs.Put(std::to_string(sum)));
  return result;
}

using StageMap = std::map<std::string, StageFunction, std::less<>>;

inline StageMap ToyStages() { return {{"split", Split}, {"square", Square}, {"sum", Sum}}; }

/// `stages` outlives the lookup.
inline StageLookup LookupIn(const StageMap& stages) {
  return [&stages](std::string_view stage) -> const StageFunction* {
    const auto found = stages.find(stage);
    return found == stages.end() ? nullptr : &found->second;
  };
}

/// Puts the input of a toy job.
inline absl::StatusOr<JobSpec> PrepareToyJob(BlobAccess& blobs,
                                             const std::string& numbers,
                                             const std::string& options_text = "") {
  JobSpec job{.kind = "toy", .options_text = options_text, .label = "squares of " + numbers};
  ORBWEAVE_ASSIGN_OR_RETURN(job.inputs.emplace_back(), blobs.Put(numbers));
  return job;
}

/// What the last stage of a finished toy job says.
inline absl::StatusOr<std::string> ToyAnswer(ClientApi& api, const Digest& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes, api.GetOutcomes(job));
  if (outcomes.empty() || outcomes.back().stage != "sum")
    return absl::FailedPreconditionError("not summed yet");
  return api.Get(outcomes.back().result.outputs.at(0));
}

}  // namespace orbweave::testing
