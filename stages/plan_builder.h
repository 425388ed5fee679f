// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/pipeline/job_plan.h"
#include "stages/option_sections.h"
#include "stages/port.h"
#include "stages/stage_facts.h"

namespace orbweave {

/// What the stage S of a plan leaves, as ports. For stages that come later in a loop; of a stage
/// that was added PlanBuilder::Add returns the same.
template <typename S>
typename S::Outputs OutputsOf() {
  const std::string stage(S::kFacts.name);
  typename S::Outputs outputs;
  uint32_t next = 0;
  const auto bind = [&]<typename Port>(std::string_view name, Port S::Outputs::*port) {
    InputRule& from = (outputs.*port).from;
    from = {internal::InfoOf(name, &(outputs.*port)).kind, stage, 0};
    if (!internal::kIsParts<Port>) from.index = next++;
  };
  S::Outputs::VisitPorts(bind);
  return outputs;
}

/// What a job brings, as ports. The order of VisitPorts is that of JobSpec::inputs.
template <typename Job>
Job InputsOf() {
  Job job;
  uint32_t next = 0;
  Job::VisitPorts([&]<typename Port>(std::string_view, Port Job::*port) {
    (job.*port).from = {InputRule::Kind::kJobInput, "", next++};
  });
  return job;
}

/// Writes a plan down, stage by stage, in the order in which they run.
class PlanBuilder {
 public:
  explicit PlanBuilder(std::string_view kind) : plan_{.kind = std::string(kind)} {}

  /// The next stage, wired to what it reads.
  template <typename S>
  typename S::Outputs Add(const S& stage) {
    StageRule rule{.stage = std::string(S::kFacts.name),
                   .version = std::string(S::kFacts.version),
                   .option_sections = S::Options::Names(),
                   .needs = S::kFacts.needs,
                   .weight = S::kFacts.weight};
    S::VisitPorts([&]<typename Port>(std::string_view, Port S::*port) {
      if constexpr (internal::kIsParts<Port>) {
        SetParts((stage.*port).from, rule);
      } else {
        rule.inputs.push_back((stage.*port).from);
      }
    });
    plan_.stages.push_back(std::move(rule));
    return OutputsOf<S>();
  }

  /// The stages from `First` to the last one added are a loop, which usually runs `usual_runs`
  /// times and never more than `max_rounds`. See StageRule::back_to.
  template <typename First>
  void RepeatFrom(double usual_runs, uint32_t max_rounds) {
    plan_.stages.back().back_to = std::string(First::kFacts.name);
    plan_.stages.back().max_rounds = max_rounds;
    const auto first =
        std::ranges::find(plan_.stages, plan_.stages.back().back_to, &StageRule::stage);
    ORBWEAVE_CHECK(first != plan_.stages.end());
    for (auto rule = first; rule != plan_.stages.end(); ++rule) rule->usual_runs = usual_runs;
  }

  [[nodiscard]] JobPlan Finish() && { return std::move(plan_); }

 private:
  static void SetParts(const InputRule& from, StageRule& rule) {
    ORBWEAVE_CHECK(rule.HasOnePart());
    if (from.kind == InputRule::Kind::kJobInput) {
      rule.parts_listed_in = from.index;
    } else {
      rule.parts_from = from.stage;
    }
    rule.inputs.push_back({InputRule::Kind::kRecipe, "", 0});
  }

  JobPlan plan_;
};

}  // namespace orbweave
