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

auto PlaceOf(const SiftCandidate& c) {
  return std::tie(
      c.keypoint.y_px, c.keypoint.x_px, c.keypoint.scale_px, c.keypoint.orientation_rad);
}

struct Ranked {
  double merit = 0.0;
  const SiftCandidate* candidate = nullptr;
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
double MeritOf(const SiftCandidate& candidate) {
  return double{candidate.response} * candidate.keypoint.scale_px;
}

std::vector<Ranked> RankedByMerit(const std::vector<SiftCandidate>& candidates) {
  std::vector<Ranked> ranked;
  for (const SiftCandidate& candidate : candidates)
    ranked.push_back({MeritOf(candidate), &candidate});
  std::sort(ranked.begin(), ranked.end(), Better);
  return ranked;
}

}  // namespace

std::vector<SiftCandidate> SelectSpread(const EquirectangularCamera& camera,
                                        const std::vector<SiftCandidate>& candidates,
                                        size_t max_features) {
  std::vector<Ranked> ranked = RankedByMerit(candidates);
  const double fair_share = static_cast<double>(max_features) / (kCellColumns * kCellRows);
  std::vector<double> ahead_in_cell(kCellColumns * kCellRows, 0.0);
  for (Ranked& r : ranked) {
    double& ahead = ahead_in_cell[static_cast<size_t>(CellOf(camera, r.candidate->keypoint))];
    r.merit /= std::sqrt(1.0 + ahead / fair_share);
    ahead += 1.0;
  }
  std::sort(ranked.begin(), ranked.end(), Better);
  ranked.resize(std::min(ranked.size(), max_features));

  std::vector<SiftCandidate> selected;
  for (const Ranked& r : ranked) selected.push_back(*r.candidate);
  std::sort(selected.begin(), selected.end(), [](const auto& a, const auto& b) {
    return PlaceOf(a) < PlaceOf(b);
  });
  return selected;
}

}  // namespace orbweave
