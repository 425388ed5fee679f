// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/fit_seams.h"
#include "stages/stage.h"

namespace orbweave {

/// All seams -> a similarity per submodel, and which seams contradict loops (AlignSubmodels).
struct AlignSubmodelsStage {
  static constexpr StageFacts kFacts{.name = "align_submodels", .version = "10", .weight = 0.1};
  using Options = OptionSections<AlignOptions>;

  EachPart<SeamsOfCluster> seams;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("seams", &AlignSubmodelsStage::seams);
  }

  struct Outputs {
    using Stage = AlignSubmodelsStage;
    One<Alignment> alignment{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("alignment", &Outputs::alignment);
    }
  };

  static absl::Status Run(StageTask<AlignSubmodelsStage>& task);
};

}  // namespace orbweave
