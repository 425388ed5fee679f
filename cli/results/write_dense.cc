// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/write_dense.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "absl/strings/str_cat.h"
#include "cli/results/cloud_writer.h"
#include "cli/results/dense_pictures.h"
#include "cli/results/report_stages.h"
#include "core/io/file.h"
#include "core/pipeline/build_version.h"
#include "core/report/check_results.h"
#include "core/report/dense_report_html.h"
#include "core/report/dense_report_json.h"
#include "stages/assemble_tile/stage.h"
#include "stages/check_depths/stage.h"
#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/job_reader.h"
#include "stages/plan_depths/stage.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// What a part of check_depths says of its map, as far as it says anything.
struct CheckedMap {
  double coverage = 0.0;
  std::string problem{};
};

CheckedMap ParseChecked(const std::string& text) {
  CheckedMap map;
  const auto report = nlohmann::json::parse(text, nullptr, false);
  if (!report.is_object()) return map;
  const auto coverage = report.find("coverage");
  if (coverage != report.end() && coverage->is_number())
    map.coverage = std::clamp(coverage->get<double>(), 0.0, 1.0);
  const auto problem = report.find("problem");
  if (problem != report.end() && problem->is_string()) map.problem = problem->get<std::string>();
  return map;
}

/// Of each panorama of the plan. DataLoss: not as many.
absl::StatusOr<std::vector<CheckedMap>> CheckedMaps(const JobReader& job, const DensePlan& plan) {
  std::vector<CheckedMap> maps;
  for (const std::string& text : job.Reports<CheckDepthsStage>())
    maps.push_back(ParseChecked(text));
  if (maps.size() == plan.panoramas.size()) return maps;
  return absl::DataLossError(
      absl::StrCat(maps.size(), " checked maps of ", plan.panoramas.size(), " panoramas"));
}

std::vector<DepthMapReport> MapReports(const std::vector<CheckedMap>& maps,
                                       const DensePlan& plan,
                                       const ImageManifest& manifest) {
  std::vector<DepthMapReport> rows;
  for (size_t i = 0; i < maps.size(); ++i)
    rows.push_back({manifest.At(plan.panoramas[i].file.image).name, maps[i].coverage});
  return rows;
}

/// Panoramas without a checked depth, and why: what took no part in the job, what the plan leaves
/// out, maps that came out empty.
std::vector<Exclusion> FindOmitted(const std::vector<CheckedMap>& maps,
                                   const DensePlan& plan,
                                   const ImageManifest& manifest) {
  std::vector<DenseOmission> omitted = plan.omitted;
  for (size_t i = 0; i < maps.size(); ++i) {
    if (!maps[i].problem.empty())
      omitted.push_back({plan.panoramas[i].file.image, maps[i].problem});
  }
  std::ranges::sort(omitted, {}, &DenseOmission::image);
  std::vector<Exclusion> named = manifest.excluded;
  for (const DenseOmission& omission : omitted)
    named.push_back({manifest.At(omission.image).name, omission.reason});
  return named;
}

}  // namespace

absl::StatusOr<DenseReport> WriteDense(ClientApi& coordinator,
                                       const JobStatus& status,
                                       const std::string& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(status.id));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(status.spec.kind));
  JobReader job(plan, status.spec, outcomes, coordinator);
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest, job.Read(&PlanDepthsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const FinalisedModel model, job.Read(&PlanDepthsStage::model));
  ORBWEAVE_ASSIGN_OR_RETURN(const DensePlan dense, job.Read(&PlanDepthsStage::Outputs::plan));
  ORBWEAVE_RETURN_IF_ERROR(CheckManifest(manifest));
  ORBWEAVE_RETURN_IF_ERROR(CheckDensePlan(dense, manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<CheckedMap> maps, CheckedMaps(job, dense));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> tiles,
                            job.List(&AssembleTileStage::Outputs::tile));
  const fs::path path(folder);
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder((path / "tiles").string()));
  const bool is_on_earth = !model.worlds.empty() && model.worlds[0].report.gnss.used;
  const auto origin = is_on_earth ? manifest.origin : std::nullopt;
  DenseReport report{.title = status.spec.label,
                     .version = std::string(BuildVersion()),
                     .is_metric = is_on_earth,
                     .maps = MapReports(maps, dense, manifest),
                     .sigma_unit = is_on_earth ? 1.0 : MedianStep(dense),
                     .omitted = FindOmitted(maps, dense, manifest),
                     .elapsed_s = status.elapsed_s,
                     .stages = ReportStages(status)};
  CloudWriter cloud(path, origin, ViewOfCloud(dense, is_on_earth));
  for (const Digest& digest : tiles) {
    ORBWEAVE_ASSIGN_OR_RETURN(const DenseTile tile, job.Fetch<DenseTile>(digest));
    ORBWEAVE_RETURN_IF_ERROR(CheckTile(tile));
    ORBWEAVE_RETURN_IF_ERROR(cloud.Add(tile, report));
  }
  ORBWEAVE_RETURN_IF_ERROR(cloud.Finish(report));
  const TopPicture from_above = cloud.FromAbove();
  DensePictures pictures{.pixel = from_above.pixel};
  ORBWEAVE_ASSIGN_OR_RETURN(pictures.from_above_png, WriteFromAbove(from_above, origin, path));
  ORBWEAVE_ASSIGN_OR_RETURN(pictures.depths,
                            DrawDepthMaps(job, dense, manifest, report, coordinator));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.json").string(), DenseReportJson(report)));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.html").string(), DenseReportHtml(report, pictures)));
  return report;
}

}  // namespace orbweave
