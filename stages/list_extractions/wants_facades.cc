// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_extractions/wants_facades.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/graph/find_near_positions.h"

namespace orbweave {
namespace {

constexpr double kNear_m = 4.0;
constexpr size_t kNeighbours = 2;
constexpr double kSigmas = 3.0;

/// Whether positions lie further from their mean than what they are off by themselves: phones in a
/// flat are as far apart as cars on a street.
bool SpanMoreThanNoise(const std::vector<Eigen::Vector2d>& positions, double sigma_m) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  const auto count = static_cast<double>(positions.size());
  for (const Eigen::Vector2d& position : positions) mean += position / count;
  double mean_square = 0.0;
  for (const Eigen::Vector2d& position : positions)
    mean_square += (position - mean).squaredNorm() / count;
  return std::sqrt(mean_square) > kSigmas * sigma_m;
}

}  // namespace

bool WantsFacades(const ImageManifest& manifest, const ExtractOptions& options) {
  if (options.facades != UseFacades::kAuto) return options.facades == UseFacades::kOn;
  std::vector<Eigen::Vector2d> positions;
  std::vector<double> sigmas_m;
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.position_in_enu) continue;
    positions.emplace_back(image.prior.position_in_enu->head<2>());
    sigmas_m.push_back(image.prior.horizontal_sigma_m);
  }
  if (!SpanMoreThanNoise(positions, Quantile(std::move(sigmas_m), 0.5))) return false;
  const auto near = FindNearPositions(positions, kNear_m, kNeighbours);
  const auto alone = std::ranges::count_if(
      near, [](const std::vector<uint32_t>& others) { return others.size() < kNeighbours; });
  return 2 * static_cast<size_t>(alone) > positions.size();
}

}  // namespace orbweave
