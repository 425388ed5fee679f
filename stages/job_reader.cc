// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/job_reader.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/pipeline/plan_stage.h"

namespace orbweave {
namespace {

using Kind = InputRule::Kind;

absl::Status NoResult(std::string_view stage) {
  return absl::NotFoundError(absl::StrCat("the job has no result of stage ", std::string(stage)));
}

}  // namespace

std::vector<const TaskOutcome*> JobReader::OutcomesOf(std::string_view stage) const {
  std::vector<const TaskOutcome*> found;
  for (const TaskOutcome& outcome : outcomes_) {
    if (outcome.stage == stage) found.push_back(&outcome);
  }
  return found;
}

absl::StatusOr<InputRule> JobReader::WiringOf(std::string_view stage, uint32_t input) const {
  const auto rule = std::ranges::find(plan_.stages, stage, &StageRule::stage);
  if (rule != plan_.stages.end() && input < rule->inputs.size()) return rule->inputs[input];
  return absl::NotFoundError(
      absl::StrCat("jobs of kind ", plan_.kind, " have no stage ", std::string(stage)));
}

absl::StatusOr<Digest> JobReader::DigestFrom(const InputRule& from) const {
  if (from.kind == Kind::kJobInput) {
    if (from.index < job_.inputs.size()) return job_.inputs[from.index];
    return absl::NotFoundError(absl::StrCat("the job has no input ", from.index));
  }
  const std::vector<const TaskOutcome*> parts = OutcomesOf(from.stage);
  if (parts.empty() || from.index >= parts.front()->result.outputs.size())
    return NoResult(from.stage);
  return parts.front()->result.outputs[from.index];
}

absl::StatusOr<std::vector<Digest>> JobReader::ListFrom(const InputRule& from) {
  if (from.kind == Kind::kJobInput) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestFrom(from));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs_.Get(digest));
    return DecodeCollection(bytes);
  }
  std::vector<Digest> digests;
  for (const TaskOutcome* part : OutcomesOf(from.stage)) {
    const std::vector<Digest>& outputs = part->result.outputs;
    if (from.kind == Kind::kAllOutputs) {
      digests.insert(digests.end(), outputs.begin(), outputs.end());
    } else if (from.index < outputs.size()) {
      digests.push_back(outputs[from.index]);
    }
  }
  return digests;
}

absl::StatusOr<std::vector<Digest>> JobReader::RecipesOf(std::string_view stage) {
  const auto rule = std::ranges::find(plan_.stages, stage, &StageRule::stage);
  if (rule == plan_.stages.end()) return NoResult(stage);
  const auto number = static_cast<uint32_t>(rule - plan_.stages.begin());
  if (rule->parts_listed_in) return ReadListedRecipes(plan_, number, job_, blobs_);
  std::vector<Digest> recipes;
  for (const TaskOutcome* part : OutcomesOf(rule->parts_from)) {
    const std::vector<Digest>& left = part->result.recipes;
    recipes.insert(recipes.end(), left.begin(), left.end());
  }
  return recipes;
}

}  // namespace orbweave
