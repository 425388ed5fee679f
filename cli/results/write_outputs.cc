// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/write_outputs.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "cli/results/fetch_results.h"
#include "cli/results/report_stages.h"
#include "cli/results/write_models.h"
#include "core/drawing/draw_carrier.h"
#include "core/io/file.h"
#include "core/io/page/cameras_csv.h"
#include "core/io/page/georeference_json.h"
#include "core/io/page/report_html.h"
#include "core/io/page/report_json.h"
#include "core/io/page/trace_json.h"
#include "core/io/page/trajectory_geojson.h"
#include "core/pipeline/build_version.h"
#include "core/report/build_job_report.h"

namespace orbweave {
namespace {

void FillRun(const JobStatus& status, const std::vector<WorkerStatus>& workers, JobReport& report) {
  report.version = std::string(BuildVersion());
  report.title = status.spec.label;
  report.options_text = status.spec.options_text;
  report.elapsed_s = status.elapsed_s;
  report.stages = ReportStages(status);
  for (const WorkerStatus& worker : workers) {
    report.workers.push_back({worker.name, worker.slots, worker.tasks_done});
  }
}

/// Models that have the job's frame on earth.
std::vector<uint32_t> ModelsOnEarth(const JobReport& report) {
  std::vector<uint32_t> models;
  for (uint32_t number = 0; number < report.each_model.size(); ++number) {
    if (report.each_model[number].gnss.used) models.push_back(number);
  }
  return models;
}

absl::Status WritePoseFiles(const JobReport& report,
                            const ImageManifest& manifest,
                            const std::filesystem::path& folder) {
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((folder / "cameras.csv").string(), CamerasCsv(report)));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically((folder / "georeference.json").string(),
                                               GeoreferenceJson(manifest, ModelsOnEarth(report))));
  const std::string geojson_path = (folder / "trajectory.geojson").string();
  if (!report.origin) {
    std::error_code ignored;
    std::filesystem::remove(geojson_path, ignored);
    return absl::OkStatus();
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string geojson, TrajectoryGeoJson(report));
  return WriteFileAtomically(geojson_path, geojson);
}

/// Masks that an earlier job left here stay: this one may have read them.
absl::Status WriteCarrierMasks(const JobReport& report, const std::filesystem::path& folder) {
  for (const ReportCarrier& carrier : report.carriers) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string mask, DrawCarrier(carrier.cells));
    ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically((folder / carrier.mask_file).string(), mask));
  }
  return absl::OkStatus();
}

absl::Status WriteTrace(JobApi& coordinator,
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

absl::StatusOr<JobReport> WriteOutputs(ClientApi& coordinator,
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
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<WorkerStatus> workers, coordinator.ListWorkers());
  FillRun(status, workers, report);

  ORBWEAVE_RETURN_IF_ERROR(WritePoseFiles(report, results.manifest, path));
  ORBWEAVE_RETURN_IF_ERROR(WriteCarrierMasks(report, path));
  ORBWEAVE_RETURN_IF_ERROR(WriteTrace(coordinator, status.id, path));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.json").string(), ReportJson(report)));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.html").string(), ReportHtml(report)));
  return report;
}

}  // namespace orbweave
