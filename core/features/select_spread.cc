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

bool Stronger(const SiftCandidate& a, const SiftCandidate& b) {
  if (a.response != b.response) return a.response > b.response;
  return PlaceOf(a) < PlaceOf(b);
}

int CellOf(const EquirectangularCamera& camera, const Keypoint& keypoint) {
  const double u = keypoint.x_px / camera.width_px;
  const double v =
      0.5 + 0.5 * std::sin((keypoint.y_px / camera.height_px - 0.5) * std::numbers::pi);
  const int column = std::clamp(static_cast<int>(u * kCellColumns), 0, kCellColumns - 1);
  const int row = std::clamp(static_cast<int>(v * kCellRows), 0, kCellRows - 1);
  return row * kCellColumns + column;
}

}  // namespace

std::vector<SiftCandidate> SelectSpread(const EquirectangularCamera& camera,
                                        std::vector<SiftCandidate> candidates,
                                        size_t max_features) {
  std::sort(candidates.begin(), candidates.end(), Stronger);
  std::vector<size_t> taken_in_cell(kCellColumns * kCellRows, 0);
  std::vector<std::pair<size_t, size_t>> round_and_index;  // strength within the cell, then overall
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto cell = static_cast<size_t>(CellOf(camera, candidates[i].keypoint));
    round_and_index.emplace_back(taken_in_cell[cell]++, i);
  }
  std::sort(round_and_index.begin(), round_and_index.end());
  round_and_index.resize(std::min(round_and_index.size(), max_features));

  std::vector<SiftCandidate> selected;
  for (const auto& [round, index] : round_and_index) selected.push_back(candidates[index]);
  std::sort(selected.begin(), selected.end(), [](const auto& a, const auto& b) {
    return PlaceOf(a) < PlaceOf(b);
  });
  return selected;
}

}  // namespace orbweave
