// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline/stage_function.h"
#include "stages/option_sections.h"
#include "stages/port.h"
#include "stages/stage_facts.h"
#include "stages/stage_task.h"

/// A stage is a struct, alone in its folder. It states everything that anybody else needs to know
/// of it:
///
///   struct AlignSubmodelsStage {
///     static constexpr StageFacts kFacts{.name = "align_submodels", .version = "4"};
///     using Options = OptionSections<AlignOptions>;  // all the options that it can read
///
///     EachPart<SeamsOfCluster> seams;  // one member per input, wired in stages/plans.cc
///     template <typename Visitor>
///     static void VisitPorts(Visitor&& visit) {
///       visit("seams", &AlignSubmodelsStage::seams);
///     }
///
///     struct Outputs {
///       using Stage = AlignSubmodelsStage;
///       One<Alignment> alignment{};
///       template <typename Visitor>
///       static void VisitPorts(Visitor&& visit) {
///         visit("alignment", &Outputs::alignment);
///       }
///     };
///
///     static absl::Status Run(StageTask<AlignSubmodelsStage>& task);
///   };
///
/// The order of ports is that of the digests in TaskSpec::inputs and TaskResult::outputs.

namespace orbweave {

/// A stage as data.
struct Stage {
  StageFacts facts{};
  std::vector<std::string> option_sections{};
  std::vector<PortInfo> inputs{};
  std::vector<PortInfo> outputs{};  ///< and recipes
  StageFunction run{};
};

template <typename S>
[[nodiscard]] Stage Describe() {
  return {.facts = S::kFacts,
          .option_sections = S::Options::Names(),
          .inputs = PortsOf<S>(),
          .outputs = PortsOf<typename S::Outputs>(),
          .run = [](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
            return RunTaskOf<S>(spec, blobs, context, S::Run);
          }};
}

}  // namespace orbweave
