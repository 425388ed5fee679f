// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/write_outputs.h"

#include <filesystem>
#include <map>
#include <utility>

#include "cli/fetch_results.h"
#include "cli/write_models.h"
#include "core/io/cameras_csv.h"
#include "core/io/file.h"
#include "core/io/georeference_json.h"
#include "core/io/report_html.h"
#include "core/io/report_json.h"
#include "core/io/trace_json.h"
#include "core/io/trajectory_geojson.h"
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

absl::Status WriteMainModelFiles(const JobResults& results,
                                 bool georeferenced,
                                 const std::filesystem::path& folder) {
  const std::map<ImageId, RegisteredImage> none;
  const std::map<ImageId, RegisteredImage>& main =
      results.models.empty() ? none : results.models.front().images;
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
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Digest> feature_names,
                            FetchFeatureNames(coordinator, status.spec, outcomes));
  const std::filesystem::path path(folder);
  ModelWriter models(coordinator, std::move(feature_names), path);
  ORBWEAVE_ASSIGN_OR_RETURN(const JobResults results,
                            FetchResults(coordinator, status.spec, outcomes, &models));
  ORBWEAVE_RETURN_IF_ERROR(models.Finish());
  JobReport report = BuildJobReport(results);
  FillRun(status, report);

  ORBWEAVE_RETURN_IF_ERROR(WriteMainModelFiles(results, report.origin.has_value(), path));
  ORBWEAVE_RETURN_IF_ERROR(WriteTrace(coordinator, status.id, path));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.json").string(), ReportJson(report)));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.html").string(), ReportHtml(report)));
  return report;
}

}  // namespace orbweave
