// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/wants_facades.h"

#include <algorithm>
#include <vector>

#include "core/graph/find_near_positions.h"

namespace orbweave {
namespace {

constexpr double kNear_m = 4.0;
constexpr size_t kNeighbours = 2;

}  // namespace

bool WantsFacades(const ImageManifest& manifest, const ExtractOptions& options) {
  if (options.facades != UseFacades::kAuto) return options.facades == UseFacades::kOn;
  std::vector<Eigen::Vector2d> positions;
  for (const ImageRecord& image : manifest.images) {
    if (image.prior.position_in_enu) positions.emplace_back(image.prior.position_in_enu->head<2>());
  }
  const auto near = FindNearPositions(positions, kNear_m, kNeighbours);
  const auto alone = std::ranges::count_if(
      near, [](const std::vector<uint32_t>& others) { return others.size() < kNeighbours; });
  return 2 * static_cast<size_t>(alone) > positions.size();
}

}  // namespace orbweave
