// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/write_dense.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "absl/strings/str_cat.h"
#include "cli/format_dense.h"
#include "core/io/file.h"
#include "core/io/utm_frame.h"
#include "core/io/write_dense_ply.h"
#include "core/io/write_las.h"
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

size_t SigmaBin(float sigma_m) {
  const double millimetres = 1000.0 * sigma_m;
  size_t bin = 0;
  while (bin + 1 < DenseReport::kSigmaBins && millimetres >= std::ldexp(1.0, static_cast<int>(bin)))
    ++bin;
  return bin;
}

TileReport Describe(const DenseTile& tile, std::string file) {
  TileReport report{.cell = tile.cell,
                    .file = std::move(file),
                    .num_points = tile.points.size(),
                    .low = tile.points.front().position_in_world,
                    .high = tile.points.front().position_in_world};
  for (const SurfacePoint& point : tile.points) {
    report.low = report.low.cwiseMin(point.position_in_world);
    report.high = report.high.cwiseMax(point.position_in_world);
  }
  return report;
}

void Count(const DenseTile& tile, DenseReport& report) {
  report.num_points += tile.points.size();
  for (const SurfacePoint& point : tile.points) {
    ++report.by_sigma[SigmaBin(point.sigma_m)];
    ++report.by_views[std::min<size_t>(point.views, DenseReport::kViewBins - 1)];
  }
}

double MeanCoverage(const JobReader& job) {
  double sum = 0.0;
  const std::vector<std::string> reports = job.Reports<CheckDepthsStage>();
  for (const std::string& text : reports)
    sum += nlohmann::json::parse(text, nullptr, false).value("coverage", 0.0);
  return reports.empty() ? 0.0 : sum / static_cast<double>(reports.size());
}

/// Panoramas without a checked depth, and why: what took no part in the job, what the plan leaves
/// out, maps that came out empty.
absl::StatusOr<std::vector<Exclusion>> FindOmitted(JobReader& job,
                                                   const DensePlan& plan,
                                                   const ImageManifest& manifest) {
  std::vector<DenseOmission> omitted = plan.omitted;
  const std::vector<std::string> reports = job.Reports<CheckDepthsStage>();
  for (size_t i = 0; i < reports.size() && i < plan.panoramas.size(); ++i) {
    const auto report = nlohmann::json::parse(reports[i], nullptr, false);
    const std::string problem = report.value("problem", "");
    if (!problem.empty()) omitted.push_back({plan.panoramas[i].file.image, problem});
  }
  std::ranges::sort(omitted, {}, &DenseOmission::image);
  std::vector<Exclusion> named = manifest.excluded;
  for (const DenseOmission& omission : omitted)
    named.push_back({manifest.At(omission.image).name, omission.reason});
  return named;
}

/// Writes tiles one after the other.
class CloudWriter {
 public:
  CloudWriter(fs::path folder, const std::optional<GeodeticPosition>& origin) : folder_(folder) {
    if (origin) utm_.emplace(*origin);
    LasDescription description;
    if (utm_) description = {.offset = utm_->Origin(), .wkt = utm_->Wkt()};
    las_.emplace((folder / "cloud.las").string(), description);
  }

  [[nodiscard]] absl::Status Add(const DenseTile& tile, DenseReport& report) {
    if (tile.points.empty()) return absl::OkStatus();
    const std::string file = absl::StrCat("tiles/", tile.cell.x, "_", tile.cell.y, ".ply");
    DensePlyWriter ply((folder_ / file).string());
    ply.Add(tile.points);
    ORBWEAVE_RETURN_IF_ERROR(ply.Finish());
    if (utm_) {
      las_->Add(utm_->FromEnu(tile.points));
    } else {
      las_->Add(tile.points);
    }
    Count(tile, report);
    report.tiles.push_back(Describe(tile, file));
    return absl::OkStatus();
  }

  [[nodiscard]] absl::Status Finish() { return las_->Finish(); }

 private:
  fs::path folder_;
  std::optional<UtmFrame> utm_;
  std::optional<LasWriter> las_;
};

/// What an earlier run left in `folder` and nobody writes any more.
void RemoveOthers(const fs::path& folder, const std::vector<TileReport>& tiles) {
  std::set<std::string> kept;
  for (const TileReport& tile : tiles) kept.insert(fs::path(tile.file).filename().string());
  std::error_code ignored;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".ply" && !kept.contains(entry.path().filename().string()))
      stale.push_back(entry.path());
  }
  for (const fs::path& path : stale) fs::remove(path, ignored);
}

void FillTimes(const JobStatus& status, DenseReport& report) {
  report.elapsed_s = status.elapsed_s;
  for (const StageStatus& stage : status.stages) report.cpu_s += stage.cpu_s;
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
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> tiles,
                            job.List(&AssembleTileStage::Outputs::tile));
  const fs::path path(folder);
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder((path / "tiles").string()));
  const bool is_on_earth = !model.worlds.empty() && model.worlds[0].report.gnss.used;
  CloudWriter cloud(path, is_on_earth ? manifest.origin : std::nullopt);
  DenseReport report{.panoramas = static_cast<uint32_t>(dense.panoramas.size()),
                     .coverage = MeanCoverage(job)};
  for (const Digest& digest : tiles) {
    ORBWEAVE_ASSIGN_OR_RETURN(const DenseTile tile, job.Fetch<DenseTile>(digest));
    ORBWEAVE_RETURN_IF_ERROR(cloud.Add(tile, report));
  }
  ORBWEAVE_RETURN_IF_ERROR(cloud.Finish());
  RemoveOthers(path / "tiles", report.tiles);
  ORBWEAVE_ASSIGN_OR_RETURN(report.omitted, FindOmitted(job, dense, manifest));
  FillTimes(status, report);
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileAtomically((path / "report.json").string(), DenseReportJson(report)));
  return report;
}

}  // namespace orbweave
