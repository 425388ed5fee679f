// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/stations.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/scene/reconstruction.h"

namespace orbweave {
namespace {

/// Of the points of an image; places far from each other have the skyline in common.
constexpr double kCommonShare = 1.0 / 3.0;

/// The points that each image sees.
std::vector<std::vector<PointIndex>> PointsOfImages(const MappingState& state) {
  std::vector<std::vector<PointIndex>> points(state.Graph().NumImages());
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    for (const ImageSlot image : ImagesThatSee(state, p)) points[image].push_back(p);
  }
  return points;
}

}  // namespace

Stations::Stations(const MappingState& state, double max_angle_rad)
    : first_(state.Graph().NumImages()), rank_(first_.size()) {
  std::iota(first_.begin(), first_.end(), ImageSlot{0});
  const std::vector<std::vector<PointIndex>> points = PointsOfImages(state);
  uint32_t next_rank = 0;
  for (ImageSlot image = 0; image < first_.size(); ++image) {
    std::map<ImageSlot, std::vector<double>> angles_rad;  // by the first image of a station
    for (const PointIndex p : points[image]) {
      const Eigen::Vector3d& position = state.Point(p).position;
      for (const ImageSlot other : ImagesThatSee(state, p)) {
        if (other < image && first_[other] == other)
          angles_rad[other].push_back(
              AngleBetween(state.Centre(image) - position, state.Centre(other) - position));
      }
    }
    for (auto& [other, angles] : angles_rad) {
      if (angles.size() < kFewestThatTellSize ||
          static_cast<double>(angles.size()) <
              kCommonShare * static_cast<double>(points[image].size()))
        continue;
      if (Quantile(std::move(angles), 0.5) >= max_angle_rad) continue;
      first_[image] = other;
      break;
    }
    if (first_[image] == image) rank_[image] = next_rank++;
  }
}

}  // namespace orbweave
