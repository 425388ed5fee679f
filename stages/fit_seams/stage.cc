// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/fit_seams/stage.h"

#include <nlohmann/json.hpp>
#include <span>

#include "stages/codecs.h"
#include "stages/load_rims.h"

namespace orbweave {

absl::Status FitSeamsStage::Run(StageTask<FitSeamsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> boundaries,
                            task.Read(&FitSeamsStage::boundaries));
  if (boundaries.empty()) return absl::InvalidArgumentError("fit_seams: no cluster");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Submodel> own,
                            LoadBoundaries(std::span(boundaries).first(1), task.blobs()));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Submodel> later,
                            LoadBoundaries(std::span(boundaries).subspan(1), task.blobs()));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const SeamsOfCluster seams,
      FitSeams(own, later, task.options<AlignOptions>().max_error_px, task.context()));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::seams, seams).status());
  task.Report(nlohmann::json{{"submodels", own.size()}, {"seams", seams.seams.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
