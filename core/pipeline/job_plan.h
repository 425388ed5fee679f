// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/digest.h"
#include "core/base/status.h"
#include "core/pipeline/stage_needs.h"
#include "core/pipeline/task.h"

namespace orbweave {

/// Where one input of a stage comes from.
struct InputRule {
  enum class Kind {
    kJobInput,    ///< the job's input blob number `index`
    kOutput,      ///< output number `index` of the (only) task of stage `stage`
    kCollection,  ///< a list blob: output number `index` of all parts of `stage`, in part order
    kAllOutputs,  ///< a list blob: all outputs of all parts of `stage`, in part order
    kRecipe,  ///< recipe of this part: what `parts_from` emitted or `parts_listed_in` lists for it
  };
  Kind kind = Kind::kJobInput;
  std::string stage{};
  uint32_t index = 0;
};

/// One row of a plan. A stage may read, of a loop, what a stage that comes later (or itself) left
/// in the round before; in the first round that is the empty blob. A stage has one part, or as many
/// as stage `parts_from` emitted recipes, or as many as the collection in job input
/// `parts_listed_in` lists. No part at all is a stage that is done.
struct StageRule {
  std::string stage{};
  /// Of the stage's algorithm. It is part of a task's id: when what a stage computes changes it is
  /// raised, and results of the older code are not taken for those of the newer.
  std::string version{};
  std::string parts_from{};  ///< empty: one part
  std::optional<uint32_t>
      parts_listed_in{};  ///< each digest listed there is the recipe of one part
  std::vector<InputRule> inputs{};
  std::vector<std::string>
      option_sections{};  ///< option sections whose change makes the stage run again
  /// The last stage of a loop: the job goes back to this stage after it as long as it has parts or,
  /// where it always has one, as long as that leaves a recipe.
  std::string back_to{};
  uint32_t max_rounds = 1000;  ///< of that loop; a job that asks for more fails (LoopGuard)
  StageNeeds needs{};          ///< of one task
  double weight = 1.0;         ///< what a run usually costs beside those of the plan's other stages
  double usual_runs = 1.0;     ///< how often it usually runs: more than once in a long loop

  /// One part whatever the stages before left.
  [[nodiscard]] bool HasOnePart() const { return parts_from.empty() && !parts_listed_in; }
};

/// A kind of job: its stages in order. A stage starts when all stages before it are done. Loops do
/// not meet.
struct JobPlan {
  std::string kind{};
  std::vector<StageRule> stages{};
};

/// The stage that follows number `stage` when its parts left `results`; the number of stages: none.
[[nodiscard]] uint32_t StageAfter(const JobPlan& plan,
                                  uint32_t stage,
                                  const std::vector<TaskResult>& results);

/// Where whoever runs jobs finds their plans. NotFound: there is no such kind of job.
using PlanLookup = std::function<absl::StatusOr<JobPlan>(std::string_view kind)>;

/// Knows no kind of job.
[[nodiscard]] absl::StatusOr<JobPlan> FindNoPlan(std::string_view kind);

/// The lines of `options_text` ("section.key=value") that belong to one of `sections`, in order.
[[nodiscard]] std::string SelectSections(std::string_view options_text,
                                         const std::vector<std::string>& sections);

/// A collection blob: concatenated 32-byte digests, and back. InvalidArgument when the size is no
/// multiple of 32.
[[nodiscard]] std::string EncodeCollection(const std::vector<Digest>& digests);
[[nodiscard]] absl::StatusOr<std::vector<Digest>> DecodeCollection(std::string_view bytes);

}  // namespace orbweave
