// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/cloud_writer.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/io/points/write_dense_ply.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

size_t SigmaBin(double sigma) {
  const auto& bounds = DenseReport::kSigmaBounds;
  const auto above = std::ranges::upper_bound(bounds, 1000.0 * sigma);
  return static_cast<size_t>(std::distance(bounds.begin(), above));
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
    ++report.by_sigma[SigmaBin(point.sigma_m / report.sigma_unit)];
    ++report.by_views[std::min<size_t>(point.views, DenseReport::kViewBins - 1)];
  }
}

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

}  // namespace

CloudWriter::CloudWriter(fs::path folder,
                         const std::optional<GeodeticPosition>& origin,
                         TopView view)
    : folder_(std::move(folder)), view_(std::move(view)) {
  if (origin) utm_.emplace(*origin);
  LasDescription description;
  if (utm_) description = {.offset = utm_->Origin(), .wkt = utm_->Wkt()};
  las_.emplace((folder_ / "cloud.las").string(), description);
}

absl::Status CloudWriter::Add(const DenseTile& tile, DenseReport& report) {
  if (tile.points.empty()) return absl::OkStatus();
  const std::string piece = tile.piece == 0 ? "" : absl::StrCat("_", tile.piece);
  const std::string file = absl::StrCat("tiles/", tile.cell.x, "_", tile.cell.y, piece, ".ply");
  DensePlyWriter ply((folder_ / file).string());
  ply.Add(tile.points);
  ORBWEAVE_RETURN_IF_ERROR(ply.Finish());
  if (utm_) {
    las_->Add(utm_->FromEnu(tile.points));
  } else {
    las_->Add(tile.points);
  }
  view_.Add(tile.points);
  Count(tile, report);
  report.tiles.push_back(Describe(tile, file));
  return absl::OkStatus();
}

absl::Status CloudWriter::Finish(const DenseReport& report) {
  ORBWEAVE_RETURN_IF_ERROR(las_->Finish());
  RemoveOthers(folder_ / "tiles", report.tiles);
  return absl::OkStatus();
}

}  // namespace orbweave
