// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/jobs/dense_job.h"

#include <functional>

#include "cli/jobs/run_local_job.h"
#include "cli/results/finished_job.h"
#include "cli/results/write_job.h"
#include "stages/check_options_together.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/job_reader.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plans.h"
#include "stages/prepare_dense_job.h"

namespace orbweave {
namespace {

using Prepare = std::function<absl::StatusOr<JobSpec>(ClientApi&, const StageContext&)>;

absl::Status RunInto(const std::string& folder,
                     const std::string& cloud_folder,
                     const FleetArgument& fleet,
                     const StopSignals& signals,
                     const Prepare& prepare) {
  const auto conclude = [&cloud_folder](ClientApi& coordinator, const JobStatus& status) {
    return WriteJob(coordinator, status, cloud_folder);
  };
  const LocalJob job{.output = folder, .fleet = fleet, .prepare = prepare, .conclude = conclude};
  return RunLocalJob(job, signals);
}

}  // namespace

absl::StatusOr<JobSpec> DenseJobOf(ClientApi& coordinator,
                                   const JobStatus& sparse,
                                   const PipelineOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckDenseOptions(options.sources));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(sparse.spec.kind));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(sparse.id));
  const JobReader reader(plan, sparse.spec, outcomes, coordinator);
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest manifest, reader.Name(&PartitionViewGraphStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest model,
                            reader.Name(&ConcludeAdjustmentStage::Outputs::model));
  JobInputs<DenseJob> inputs;
  inputs.Set(&DenseJob::manifest, manifest).Set(&DenseJob::model, model);
  return JobSpec{.kind = std::string(DenseJob::kKind),
                 .inputs = inputs.InOrder(),
                 .options_text = PipelineOptionsToText(options),
                 .label = sparse.spec.label};
}

absl::Status RunDenseJob(const std::string& output,
                         const FleetArgument& fleet,
                         const PipelineOptions& options,
                         const StopSignals& signals) {
  ORBWEAVE_RETURN_IF_ERROR(CheckHoldsJob(output));
  const auto prepare = [&](ClientApi& coordinator, const StageContext&) -> absl::StatusOr<JobSpec> {
    ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus sparse, LastFinishedJob(coordinator, output));
    return DenseJobOf(coordinator, sparse, options);
  };
  return RunInto(output, output + "/dense", fleet, signals, prepare);
}

absl::Status RunDenseJobOnColmap(const std::string& colmap_model,
                                 const ScanRequest& images,
                                 const std::string& output,
                                 const FleetArgument& fleet,
                                 const PipelineOptions& options,
                                 const StopSignals& signals) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ColmapModel model, ReadColmapModel(colmap_model));
  const auto prepare = [&](ClientApi& coordinator, const StageContext& context) {
    return PrepareDenseJob(coordinator, model, images, options, context);
  };
  return RunInto(output, output, fleet, signals, prepare);
}

}  // namespace orbweave
