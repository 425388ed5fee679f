// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align_submodels/stage.h"

#include <nlohmann/json.hpp>

#include "core/merging/alignment/align_submodels.h"
#include "stages/codecs.h"

namespace orbweave {

absl::Status AlignSubmodelsStage::Run(StageTask<AlignSubmodelsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<SeamsOfCluster> clusters,
                            task.ReadAll(&AlignSubmodelsStage::seams));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment,
                            AlignSubmodels(clusters, task.options<AlignOptions>(), task.context()));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::alignment, alignment).status());
  task.Report(
      nlohmann::json{{"submodels", alignment.submodels.size()}, {"seams", alignment.seams.size()}}
          .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
