// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/scene_lean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kMaxPoints = 1000;  // per subproblem: some for every panorama of a cluster
constexpr size_t kMinPoints = 200;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr int kSteps = 40;  // on either side
constexpr double kStep_rad = 0.5 * kRadPerDeg;
// A road's roughness and the error of a point some metres away; at 8 m to the side one and a half
// degrees are a bin.
constexpr double kBin_m = 0.2;
constexpr double kReach_m = 12.0;
constexpr int kNumBins = static_cast<int>(2.0 * kReach_m / kBin_m);
constexpr int kNeighbours = 6;         // on either side, for what a bin would have by itself
constexpr double kChanceSigmas = 4.0;  // of the largest of some hundred bins
// Points that stand out, of all: less is a kerb or a coincidence.
constexpr double kMinShare = 0.03;

using Bins = std::array<double, kNumBins>;

void Count(double value_m, Bins& bins) {
  if (!(std::abs(value_m) < kReach_m)) return;
  const auto bin = static_cast<int>((value_m + kReach_m) / kBin_m);
  bins[static_cast<size_t>(std::min(bin, kNumBins - 1))] += 1.0;
}

struct Peaks {
  double squares = 0.0;
  double points = 0.0;
};

void AddPeaks(const Bins& bins, Peaks& peaks) {
  for (int i = 0; i < kNumBins; ++i) {
    std::vector<double> neighbours;
    for (int j = std::max(0, i - kNeighbours); j <= std::min(kNumBins - 1, i + kNeighbours); ++j)
      neighbours.push_back(bins[static_cast<size_t>(j)]);
    const double usual = Quantile(std::move(neighbours), 0.5);
    const double above =
        bins[static_cast<size_t>(i)] - usual - kChanceSigmas * std::sqrt(std::max(usual, 1.0));
    if (above <= 0.0) continue;
    peaks.squares += above * above;
    peaks.points += above;
  }
}

}  // namespace

std::vector<Eigen::Vector3d> PointsAboutPanoramas(const Subproblem& subproblem) {
  std::map<ImageId, Eigen::Vector3d> centres;
  for (const auto& [id, image] : subproblem.scene.images)
    centres[id] = image.cam_from_world.Centre();
  const std::vector<Track>& tracks = subproblem.scene.tracks;
  const size_t stride = std::max<size_t>(1, (tracks.size() + kMaxPoints - 1) / kMaxPoints);
  std::vector<Eigen::Vector3d> points;
  for (size_t t = 0; t < tracks.size(); t += stride) {
    Eigen::Vector3d nearest = Eigen::Vector3d::Constant(1e9);
    for (const Observation& seen : tracks[t].observations) {
      const Eigen::Vector3d away = tracks[t].point_in_world - centres.at(seen.ref.image);
      if (away.squaredNorm() < nearest.squaredNorm()) nearest = away;
    }
    points.push_back(nearest);
  }
  return points;
}

std::optional<SceneLean> MeasureSceneLean(std::span<const Eigen::Vector3d> points,
                                          const Eigen::Vector3d& axis) {
  if (points.size() < kMinPoints) return std::nullopt;
  const Eigen::Vector3d side = Eigen::Vector3d::UnitZ().cross(axis);  // to the left
  std::array<Peaks, 2 * kSteps + 1> peaks{};
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double angle_rad = kStep_rad * step;
    Bins heights{};
    Bins distances{};
    for (const Eigen::Vector3d& point : points) {
      const double left_m = point.dot(side);
      const double up_m = point.z();
      // Turned back by the angle about the axis, which carries left to up.
      Count(std::cos(angle_rad) * up_m - std::sin(angle_rad) * left_m, heights);
      Count(std::cos(angle_rad) * left_m + std::sin(angle_rad) * up_m, distances);
    }
    AddPeaks(heights, peaks[static_cast<size_t>(step + kSteps)]);
    AddPeaks(distances, peaks[static_cast<size_t>(step + kSteps)]);
  }
  const auto best = std::ranges::max_element(peaks, {}, &Peaks::squares);
  if (best->points < kMinShare * static_cast<double>(points.size())) return std::nullopt;
  const auto steps = static_cast<double>(best - peaks.begin()) - kSteps;
  return SceneLean{.lean_rad = kStep_rad * steps,
                   .sharpness = best->squares / std::max(peaks[kSteps].squares, 1.0)};
}

}  // namespace orbweave
