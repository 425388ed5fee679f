// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/digest.h"
#include "core/merging/alignment/fit_seams.h"
#include "stages/stage.h"

namespace orbweave {

/// The boundary of a cluster and those of later neighbours -> a similarity per seam (FitSeams).
struct FitSeamsStage {
  static constexpr StageFacts kFacts{.name = "fit_seams", .version = "2", .weight = 1.0};
  using Options = OptionSections<AlignOptions>;

  Parts<std::vector<Digest>> boundaries;  ///< its own first

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("rims", &FitSeamsStage::boundaries);
  }

  struct Outputs {
    using Stage = FitSeamsStage;
    EachPart<SeamsOfCluster> seams{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("seams", &Outputs::seams);
    }
  };

  static absl::Status Run(StageTask<FitSeamsStage>& task);
};

}  // namespace orbweave
