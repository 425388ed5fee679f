// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/merge_coincident_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/merge_points.h"

namespace orbweave {
namespace {

/// The nodes of one image that have a point, found by bearing: sorted by height in bands as wide
/// as the search radius.
class ObservedNodes {
 public:
  ObservedNodes(const MappingState& state, ImageSlot image, double radius_rad)
      : bearings_(state.Graph().bearing_of_node), radius_(radius_rad) {
    const auto& first = state.Graph().first_node;
    for (Node node = first[image]; node < first[image + 1]; ++node) {
      if (state.PointOf(node) != kNoPoint) by_height_.push_back(node);
    }
    std::sort(by_height_.begin(), by_height_.end(), [&](Node x, Node y) {
      return std::tuple(bearings_[x].y(), x) < std::tuple(bearings_[y].y(), y);
    });
  }

  /// Nodes within the radius of a unit bearing, by height.
  void FindNear(const Eigen::Vector3d& bearing, std::vector<Node>& near) const {
    near.clear();
    auto it = std::lower_bound(
        by_height_.begin(), by_height_.end(), bearing.y() - radius_, [&](Node node, double y) {
          return bearings_[node].y() < y;
        });
    for (; it != by_height_.end() && bearings_[*it].y() <= bearing.y() + radius_; ++it) {
      if ((bearings_[*it] - bearing).squaredNorm() <= radius_ * radius_) near.push_back(*it);
    }
  }

 private:
  const std::vector<Eigen::Vector3d>& bearings_;
  double radius_;
  std::vector<Node> by_height_{};
};

/// Finds what an image may have missed; remembers of each point the last image that it was found
/// for, so that it is listed once.
class NearbyPoints {
 public:
  /// Points seen by registered images that are matched with `image`, but not by `image`; ascending.
  [[nodiscard]] std::vector<PointIndex> Find(const MappingState& state, ImageSlot image) {
    const CorrespondenceGraph& graph = state.Graph();
    last_image_.resize(state.EndOfPoints(), graph.NumImages());
    std::vector<PointIndex> points;
    for (const uint32_t p : graph.pairs_of_image[image]) {
      const LinkedPair& pair = graph.pairs[p];
      const ImageSlot other = pair.Other(image);
      for (Node node = graph.first_node[other]; node < graph.first_node[other + 1]; ++node) {
        const PointIndex point = state.PointOf(node);
        if (point == kNoPoint || std::exchange(last_image_[point], image) == image) continue;
        if (!state.IsSeenBy(point, image)) points.push_back(point);
      }
    }
    std::ranges::sort(points);
    return points;
  }

 private:
  std::vector<ImageSlot> last_image_{};  ///< per point; the number of images: none yet
};

uint32_t MergeInImage(MappingState& state,
                      ImageSlot image,
                      double max_error_px,
                      NearbyPoints& nearby) {
  const Node any_node = state.Graph().first_node[image];
  const ObservedNodes observed(state, image, AngleFromPixels(state, any_node, max_error_px));
  std::vector<Node> near;
  uint32_t merged = 0;
  for (const PointIndex point : nearby.Find(state, image)) {
    if (!state.Exists(point)) continue;
    observed.FindNear((state.CamFromWorld(image) * state.Point(point).position).normalized(), near);
    for (const Node node : near) {
      const PointIndex other = state.PointOf(node);
      if (other == kNoPoint || other == point) continue;
      if (MergePair(state, point, other, max_error_px) != kNoPoint) {
        ++merged;
        break;
      }
    }
  }
  return merged;
}

}  // namespace

uint32_t MergeCoincidentPoints(MappingState& state, double max_error_px) {
  uint32_t merged = 0;
  const std::vector<ImageSlot> registered = state.Registered();
  NearbyPoints nearby;
  for (const ImageSlot image : registered)
    merged += MergeInImage(state, image, max_error_px, nearby);
  return merged;
}

}  // namespace orbweave
