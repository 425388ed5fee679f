// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/cluster_spreads.h"

#include <cmath>
#include <vector>

namespace orbweave {

Spread SpreadOf(std::span<const Eigen::Vector3d> points) {
  const auto count = static_cast<double>(points.size());
  Spread spread;
  for (const Eigen::Vector3d& point : points) spread.centre += point;
  spread.centre /= count;
  double squares = 0.0;
  for (const Eigen::Vector3d& point : points) squares += (point - spread.centre).squaredNorm();
  spread.rms = std::sqrt(squares / count);
  return spread;
}

std::map<uint32_t, Spread> ClusterSpreads(const Reconstruction& scene,
                                          const std::map<ImageId, uint32_t>& cluster_of_image) {
  std::map<uint32_t, std::vector<Eigen::Vector3d>> centres;
  for (const auto& [id, image] : scene.images) {
    if (!image.loose) centres[cluster_of_image.at(id)].push_back(image.cam_from_world.Centre());
  }
  std::map<uint32_t, Spread> spreads;
  for (const auto& [cluster, points] : centres) spreads.emplace(cluster, SpreadOf(points));
  return spreads;
}

}  // namespace orbweave
