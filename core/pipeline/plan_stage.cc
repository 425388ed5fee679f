// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/plan_stage.h"

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

struct Planner {
  const JobPlan& plan;
  uint32_t stage;
  const JobSpec& job;
  const std::vector<std::vector<TaskResult>>& results;

  [[nodiscard]] const StageRule& Rule() const { return plan.stages[stage]; }

  /// Whether the rule reads what a loop's round before left, and this is the first round.
  [[nodiscard]] bool IsFirstRound(const InputRule& rule) const {
    for (uint32_t s = stage; s < plan.stages.size(); ++s) {
      if (plan.stages[s].stage == rule.stage) return s >= results.size() || results[s].empty();
    }
    return false;
  }

  /// Results of the stage called `name`.
  [[nodiscard]] absl::StatusOr<const std::vector<TaskResult>*> ResultsOf(
      const std::string& name) const {
    for (uint32_t s = 0; s < results.size(); ++s) {
      if (plan.stages[s].stage == name) return &results[s];
    }
    return absl::FailedPreconditionError(
        absl::StrCat("stage ", Rule().stage, " asks for stage ", name, ", which did not run"));
  }

  [[nodiscard]] absl::StatusOr<Digest> JobInput(uint32_t index) const {
    if (index < job.inputs.size()) return job.inputs[index];
    return absl::InvalidArgumentError(absl::StrCat(
        "job kind ", plan.kind, " needs input ", index, ", but ", job.inputs.size(), " are given"));
  }

  [[nodiscard]] absl::StatusOr<Digest> Output(const InputRule& rule) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto* parts, ResultsOf(rule.stage));
    if (parts->size() == 1 && rule.index < parts->front().outputs.size())
      return parts->front().outputs[rule.index];
    return NoOutput(rule);
  }

  [[nodiscard]] absl::Status NoOutput(const InputRule& rule) const {
    return absl::FailedPreconditionError(absl::StrCat(
        "stage ", rule.stage, " left no output ", rule.index, " for stage ", Rule().stage));
  }

  [[nodiscard]] absl::StatusOr<std::string> AllOutputs(const InputRule& rule) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto* parts, ResultsOf(rule.stage));
    std::vector<Digest> outputs;
    for (const TaskResult& part : *parts) {
      outputs.insert(outputs.end(), part.outputs.begin(), part.outputs.end());
    }
    return EncodeCollection(outputs);
  }

  [[nodiscard]] absl::StatusOr<std::string> Collection(const InputRule& rule) const {
    ORBWEAVE_ASSIGN_OR_RETURN(const auto* parts, ResultsOf(rule.stage));
    std::vector<Digest> outputs;
    for (const TaskResult& part : *parts) {
      if (rule.index >= part.outputs.size()) return NoOutput(rule);
      outputs.push_back(part.outputs[rule.index]);
    }
    return EncodeCollection(outputs);
  }

  /// The list a rule asks for; empty in the first round of a loop.
  [[nodiscard]] absl::StatusOr<std::string> List(const InputRule& rule) const {
    if (IsFirstRound(rule)) return std::string();
    return rule.kind == InputRule::Kind::kCollection ? Collection(rule) : AllOutputs(rule);
  }

  /// One recipe per part; a single zero digest when the stage has one part that reads none.
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> Recipes(
      const std::vector<Digest>& listed) const {
    if (Rule().parts_listed_in) return listed;
    if (Rule().HasOnePart()) return std::vector<Digest>(1);
    ORBWEAVE_ASSIGN_OR_RETURN(const auto* parts, ResultsOf(Rule().parts_from));
    std::vector<Digest> recipes;
    for (const TaskResult& part : *parts) {
      recipes.insert(recipes.end(), part.recipes.begin(), part.recipes.end());
    }
    return recipes;
  }
};

}  // namespace

absl::StatusOr<StagePlan> PlanStage(const JobPlan& plan,
                                    uint32_t stage,
                                    const JobSpec& job,
                                    const std::vector<std::vector<TaskResult>>& results,
                                    const std::vector<Digest>& listed_recipes) {
  const Planner planner{plan, stage, job, results};
  if (planner.Rule().version.empty()) {
    return absl::FailedPreconditionError(
        absl::StrCat("job kind ", plan.kind, " states no version of stage ", planner.Rule().stage));
  }
  StagePlan stage_plan;
  TaskSpec common{.stage = planner.Rule().stage,
                  .version = planner.Rule().version,
                  .options_text = SelectSections(job.options_text, planner.Rule().option_sections)};
  std::vector<size_t> recipe_slots;
  for (const InputRule& rule : planner.Rule().inputs) {
    switch (rule.kind) {
      case InputRule::Kind::kJobInput: {
        ORBWEAVE_ASSIGN_OR_RETURN(common.inputs.emplace_back(), planner.JobInput(rule.index));
        break;
      }
      case InputRule::Kind::kOutput: {
        if (planner.IsFirstRound(rule)) {
          common.inputs.push_back(DigestOf(""));
          stage_plan.collections.emplace_back();
          break;
        }
        ORBWEAVE_ASSIGN_OR_RETURN(common.inputs.emplace_back(), planner.Output(rule));
        break;
      }
      case InputRule::Kind::kCollection:
      case InputRule::Kind::kAllOutputs: {
        ORBWEAVE_ASSIGN_OR_RETURN(std::string list, planner.List(rule));
        common.inputs.push_back(DigestOf(list));
        stage_plan.collections.push_back(std::move(list));
        break;
      }
      case InputRule::Kind::kRecipe: {
        recipe_slots.push_back(common.inputs.size());
        common.inputs.emplace_back();
        break;
      }
    }
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> recipes, planner.Recipes(listed_recipes));
  for (uint32_t part = 0; part < recipes.size(); ++part) {
    TaskSpec task = common;
    task.part = part;
    for (const size_t slot : recipe_slots) task.inputs[slot] = recipes[part];
    stage_plan.tasks.push_back(std::move(task));
  }
  return stage_plan;
}

absl::StatusOr<std::vector<Digest>> ReadListedRecipes(const JobPlan& plan,
                                                      uint32_t stage,
                                                      const JobSpec& job,
                                                      BlobAccess& blobs) {
  const std::optional<uint32_t> input = plan.stages[stage].parts_listed_in;
  if (!input) return std::vector<Digest>{};
  if (*input >= job.inputs.size())
    return absl::InvalidArgumentError(absl::StrCat("the job has no input ", *input));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs.Get(job.inputs[*input]));
  return DecodeCollection(bytes);
}

}  // namespace orbweave
