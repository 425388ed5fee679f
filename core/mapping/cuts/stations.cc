// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/stations.h"

#include <map>
#include <numeric>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/scene/reconstruction.h"

namespace orbweave {
namespace {

/// Of the points of an image; places far from each other have the skyline in common.
constexpr double kCommonShare = 1.0 / 3.0;

using AnglesOfStations = std::map<ImageSlot, std::vector<double>>;  // by their first image

/// Those under which an image and the first ones of stations before it see common points.
AnglesOfStations AnglesTo(const MappingState& state,
                          const std::vector<ImageSlot>& first,
                          ImageSlot image) {
  const CorrespondenceGraph& graph = state.Graph();
  AnglesOfStations angles_rad;
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    if (state.PointOf(node) == kNoPoint) continue;
    const MappedPoint& point = state.Point(state.PointOf(node));
    for (const Node seen : point.nodes) {
      const ImageSlot other = graph.image_of_node[seen];
      if (other >= image || first[other] != other) continue;
      angles_rad[other].push_back(
          AngleBetween(state.Centre(image) - point.position, state.Centre(other) - point.position));
    }
  }
  return angles_rad;
}

}  // namespace

Stations::Stations(const MappingState& state, double max_angle_rad)
    : first_(state.Graph().NumImages()), rank_(first_.size()) {
  std::iota(first_.begin(), first_.end(), ImageSlot{0});
  uint32_t next_rank = 0;
  for (ImageSlot image = 0; image < first_.size(); ++image) {
    const double least_common = kCommonShare * state.NumObservations(image);
    for (const auto& [other, angles_rad] : AnglesTo(state, first_, image)) {
      if (angles_rad.size() < kFewestThatTellSize) continue;
      if (static_cast<double>(angles_rad.size()) < least_common) continue;
      if (Quantile(angles_rad, 0.5) >= max_angle_rad) continue;
      first_[image] = other;
      break;
    }
    if (first_[image] == image) rank_[image] = next_rank++;
  }
}

}  // namespace orbweave
