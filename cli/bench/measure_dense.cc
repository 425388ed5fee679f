// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/bench/measure_dense.h"

#include <filesystem>

#include "cli/jobs/run_local_job.h"
#include "cli/results/write_dense.h"
#include "core/io/file.h"
#include "core/io/gnss/reference_poses.h"
#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/job_reader.h"
#include "stages/plan_depths/stage.h"
#include "stages/plans.h"
#include "stages/prepare_dense_job.h"

namespace orbweave {
namespace {

absl::StatusOr<ColmapModel> TrueModel(const std::string& street) {
  const std::string path = street + "/truth.csv";
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto poses, ParseReferencePoses(text, path));
  ColmapModel model;
  for (const auto& [name, cam_from_world] : poses) {
    model.images.push_back({.image_id = static_cast<uint32_t>(model.images.size() + 1),
                            .name = name,
                            .cam_from_world = cam_from_world});
  }
  return model;
}

absl::StatusOr<double> MegapixelsOf(ClientApi& coordinator, const JobStatus& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(job.id));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.spec.kind));
  JobReader reader(plan, job.spec, outcomes, coordinator);
  ORBWEAVE_ASSIGN_OR_RETURN(const DensePlan dense, reader.Read(&PlanDepthsStage::Outputs::plan));
  double pixels = 0.0;
  for (const DensePanorama& panorama : dense.panoramas) {
    const EquirectangularCamera& camera = panorama.file.camera;
    pixels += static_cast<double>(camera.width_px) * camera.height_px;
  }
  return 1e-6 * pixels;
}

}  // namespace

absl::StatusOr<DenseMeasurement> MeasureDenseJob(const std::string& street,
                                                 const PipelineOptions& options,
                                                 uint32_t workers,
                                                 const std::string& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ColmapModel model, TrueModel(street));
  ScanRequest images{.image_folder = street + "/images"};
  if (std::filesystem::exists(street + "/masks")) images.masks = street + "/masks";
  DenseMeasurement measurement{.workers = workers};
  const auto prepare = [&](BlobDepot& depot, const StageContext& context) {
    return PrepareDenseJob(depot, model, images, options, context);
  };
  const auto conclude = [&](ClientApi& coordinator, const JobStatus& job) -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(const DenseReport report, WriteDense(coordinator, job, folder));
    ORBWEAVE_ASSIGN_OR_RETURN(measurement.cloud, DigestOfFile(folder + "/cloud.las"));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<MeasuredTask> tasks, coordinator.GetCosts(job.id));
    ORBWEAVE_ASSIGN_OR_RETURN(measurement.megapixels, MegapixelsOf(coordinator, job));
    measurement.wall_s = job.elapsed_s;
    measurement.panoramas = report.maps.size();
    measurement.points = report.num_points;
    measurement.stages = SumByStage(tasks);
    return absl::OkStatus();
  };
  const StopSignals signals;
  ORBWEAVE_RETURN_IF_ERROR(RunLocalJob(
      {.output = folder, .fleet = {.workers = workers}, .prepare = prepare, .conclude = conclude},
      signals));
  return measurement;
}

}  // namespace orbweave
