// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/select_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace orbweave {
namespace {

constexpr int kCellColumns = 24;
constexpr int kCellRows = 12;

auto PlaceOf(const ScoredKeypoint& c) {
  return std::tie(
      c.keypoint.y_px, c.keypoint.x_px, c.keypoint.scale_px, c.keypoint.orientation_rad);
}

struct Ranked {
  double merit = 0.0;
  const ScoredKeypoint* candidate = nullptr;
};

bool Better(const Ranked& x, const Ranked& y) {
  if (x.merit != y.merit) return x.merit > y.merit;
  return PlaceOf(*x.candidate) < PlaceOf(*y.candidate);
}

int CellOf(const EquirectangularCamera& camera, const Keypoint& keypoint) {
  const double u = keypoint.x_px / camera.width_px;
  const double v =
      0.5 + 0.5 * std::sin((keypoint.y_px / camera.height_px - 0.5) * std::numbers::pi);
  const int column = std::clamp(static_cast<int>(u * kCellColumns), 0, kCellColumns - 1);
  const int row = std::clamp(static_cast<int>(v * kCellRows), 0, kCellRows - 1);
  return row * kCellColumns + column;
}

/// How likely a candidate is found again in another image: with its contrast, and with its scale,
/// since the finest scales of panoramas are mostly noise of the sensor and of the stitching.
double MeritOf(const ScoredKeypoint& candidate) {
  return double{candidate.response} * candidate.keypoint.scale_px;
}

std::vector<Ranked> RankedByMerit(std::span<const ScoredKeypoint> candidates) {
  std::vector<Ranked> ranked;
  for (const ScoredKeypoint& candidate : candidates)
    ranked.push_back({MeritOf(candidate), &candidate});
  std::sort(ranked.begin(), ranked.end(), Better);
  return ranked;
}

}  // namespace

std::vector<uint32_t> SelectSpread(const EquirectangularCamera& camera,
                                   std::span<const ScoredKeypoint> candidates,
                                   size_t max_features) {
  std::vector<Ranked> ranked = RankedByMerit(candidates);
  const double fair_share = static_cast<double>(max_features) / (kCellColumns * kCellRows);
  std::vector<double> ahead_in_cell(kCellColumns * kCellRows, 0.0);
  for (Ranked& r : ranked) {
    double& ahead = ahead_in_cell[static_cast<size_t>(CellOf(camera, r.candidate->keypoint))];
    r.merit /= std::sqrt(1.0 + ahead / fair_share);
    ahead += 1.0;
  }
  if (ranked.size() > max_features) {
    const auto end = ranked.begin() + static_cast<std::ptrdiff_t>(max_features);
    std::nth_element(ranked.begin(), end, ranked.end(), Better);
    ranked.erase(end, ranked.end());
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return PlaceOf(*a.candidate) < PlaceOf(*b.candidate);
  });
  std::vector<uint32_t> selected;
  for (const Ranked& r : ranked)
    selected.push_back(static_cast<uint32_t>(r.candidate - candidates.data()));
  return selected;
}

}  // namespace orbweave
