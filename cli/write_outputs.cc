// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/write_outputs.h"

#include <filesystem>

#include "cli/fetch_results.h"
#include "core/io/cameras_csv.h"
#include "core/io/colmap_model.h"
#include "core/io/file.h"
#include "core/io/georeference_json.h"
#include "core/io/report_html.h"
#include "core/io/report_json.h"
#include "core/io/trace_json.h"
#include "core/io/trajectory_geojson.h"
#include "core/io/write_ply.h"
#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

void FillRun(const JobStatus& status, JobReport& report) {
  report.version = std::string(BuildVersion());
  report.title = status.spec.label;
  report.options_text = status.spec.options_text;
  report.elapsed_s = status.elapsed_s;
  for (const StageStatus& stage : status.stages) {
    report.stages.push_back({.name = stage.stage,
                             .wall_s = stage.wall_s,
                             .cpu_s = stage.cpu_s,
                             .tasks_computed = stage.tasks_done - stage.tasks_reused,
                             .tasks_reused = stage.tasks_reused,
                             .retries = stage.retries});
  }
  for (const WorkerStatus& worker : status.workers) {
    report.workers.push_back({worker.name, worker.slots, worker.tasks_done});
  }
}

absl::StatusOr<std::vector<std::vector<Keypoint>>> FetchKeypoints(
    CoordinatorApi& coordinator, const JobSpec& job, const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Features> features,
                            FetchFeatures(coordinator, job, outcomes, false));
  std::vector<std::vector<Keypoint>> keypoints;
  for (Features& image : features) keypoints.push_back(std::move(image.keypoints));
  return keypoints;
}

/// sparse/0 ..., and no leftovers of an earlier run that had more models.
absl::Status WriteModels(const JobResults& results,
                         const std::vector<std::vector<Keypoint>>& keypoints,
                         const std::filesystem::path& folder) {
  for (size_t model = 0; model < results.worlds.size(); ++model) {
    ORBWEAVE_RETURN_IF_ERROR(WriteColmapModel(
        ToColmapModel(results.worlds[model].reconstruction, results.manifest, keypoints),
        (folder / "sparse" / std::to_string(model)).string()));
  }
  for (size_t stale = results.worlds.size();; ++stale) {
    std::error_code error;
    if (std::filesystem::remove_all(folder / "sparse" / std::to_string(stale), error) == 0 || error)
      break;
  }
  return absl::OkStatus();
}

absl::Status WriteMainModelFiles(const JobResults& results,
                                 bool georeferenced,
                                 const std::filesystem::path& folder) {
  const Reconstruction empty;
  const Reconstruction& main =
      results.worlds.empty() ? empty : results.worlds.front().reconstruction;
  ORBWEAVE_RETURN_IF_ERROR(WritePly(main, (folder / "points.ply").string()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically((folder / "cameras.csv").string(),
                                               CamerasCsv(main, results.manifest, georeferenced)));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically((folder / "georeference.json").string(),
                                               GeoreferenceJson(results.manifest, georeferenced)));
  const std::string geojson_path = (folder / "trajectory.geojson").string();
  if (!georeferenced) {
    std::error_code ignored;
    std::filesystem::remove(geojson_path, ignored);
    return absl::OkStatus();
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string geojson, TrajectoryGeoJson(main, results.manifest));
  return WriteFileAtomically(geojson_path, geojson);
}

absl::Status WriteTrace(CoordinatorApi& coordinator,
                        const Digest& job,
                        const std::filesystem::path& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskTiming> timings, coordinator.GetTimings(job));
  std::vector<TraceRow> rows;
  for (const TaskTiming& timing : timings) {
    rows.push_back({.stage = timing.stage,
                    .part = timing.part,
                    .worker = timing.worker,
                    .slot = timing.slot,
                    .start_s = timing.start_s,
                    .end_s = timing.end_s,
                    .ok = timing.ok});
  }
  return WriteFileAtomically((folder / "trace.json").string(), TraceJson(std::move(rows)));
}

}  // namespace

absl::StatusOr<JobReport> WriteOutputs(CoordinatorApi& coordinator,
                                       const JobStatus& status,
                                       const std::string& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(status.id));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobResults results,
                            FetchResults(coordinator, status.spec, outcomes));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto keypoints,
                            FetchKeypoints(coordinator, status.spec, outcomes));
  JobReport report = BuildJobReport(results);
  FillRun(status, report);

  const std::filesystem::path path(folder);
  ORBWEAVE_RETURN_IF_ERROR(WriteModels(results, keypoints, path));
  ORBWEAVE_RETURN_IF_ERROR(WriteMainModelFiles(results, report.origin.has_value(), path));
  ORBWEAVE_RETURN_IF_ERROR(WriteTrace(coordinator, status.id, path));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.json").string(), ReportJson(report)));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.html").string(), ReportHtml(report)));
  return report;
}

}  // namespace orbweave
