// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/surface_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/quantile.h"
#include "core/dense/evaluate_surface.h"
#include "core/io/points/read_ply_points.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr double kSampleSpacing_m = 0.05;

absl::StatusOr<std::vector<Eigen::Vector3d>> ReadCloud(const std::string& folder,
                                                       const Sim3& reference_from_model) {
  std::vector<std::string> tiles;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "tiles", none)) {
    if (entry.path().extension() == ".ply") tiles.push_back(entry.path().string());
  }
  if (tiles.empty()) {
    return absl::NotFoundError(folder +
                               " holds no dense cloud; `orbweave dense` computes one first");
  }
  std::ranges::sort(tiles);
  std::vector<Eigen::Vector3d> cloud;
  for (const std::string& tile : tiles) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Eigen::Vector3d> points, ReadPlyPoints(tile));
    for (const Eigen::Vector3d& point : points) cloud.push_back(reference_from_model * point);
  }
  return cloud;
}

/// Median distance from a sample of the truth to the next, of 200 of them.
double SpacingOf(const std::vector<Eigen::Vector3d>& truth) {
  std::vector<double> spacings;
  const size_t stride = std::max<size_t>(1, truth.size() / 200);
  for (size_t i = 0; i < truth.size(); i += stride) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < truth.size(); ++k) {
      if (k != i) nearest = std::min(nearest, (truth[k] - truth[i]).squaredNorm());
    }
    spacings.push_back(std::sqrt(nearest));
  }
  return Quantile(std::move(spacings), 0.5);
}

}  // namespace

absl::StatusOr<std::string> SurfaceText(const std::string& cloud_folder,
                                        const std::string& surface,
                                        const Sim3& reference_from_model,
                                        std::vector<Eigen::Vector3d> centres) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Eigen::Vector3d> truth, ReadPlyPoints(surface));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Eigen::Vector3d> cloud,
                            ReadCloud(cloud_folder, reference_from_model));
  const SurfaceRegion region{.centres = std::move(centres), .sample_spacing_m = kSampleSpacing_m};
  const SurfaceEvaluation found = EvaluateSurface(cloud, truth, {}, region);
  std::string text = absl::StrFormat(
      "  surface     %zu points against %zu samples, median %.4f m; samples are %.2f m "
      "apart, and no precision is told within less\n",
      found.cloud_points,
      found.truth_points,
      found.median_error_m,
      SpacingOf(truth));
  for (const SurfaceScore& score : found.scores) {
    absl::StrAppendFormat(
        &text,
        "              within %2.0f cm: precision %5.1f %%, recall %5.1f %%, F1 %5.1f %%\n",
        100.0 * score.tolerance_m,
        100.0 * score.precision,
        100.0 * score.recall,
        100.0 * score.f1);
  }
  return text;
}

}  // namespace orbweave
