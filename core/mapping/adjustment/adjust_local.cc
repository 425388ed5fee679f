// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_local.h"

#include <algorithm>
#include <tuple>

#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/complete_tracks.h"
#include "core/mapping/model/drop_near_points.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/merge_points.h"

namespace orbweave {
namespace {

/// Points seen by the first image of the window or by two others of it, ascending.
std::vector<PointIndex> PointsOfWindow(const MappingState& state,
                                       const std::vector<ImageSlot>& window) {
  std::vector<PointIndex> seen;
  for (const ImageSlot image : window) {
    const int times = image == window.front() ? 2 : 1;
    for (Node node = state.Graph().first_node[image]; node < state.Graph().first_node[image + 1];
         ++node) {
      if (state.PointOf(node) == kNoPoint) continue;
      for (int i = 0; i < times; ++i) seen.push_back(state.PointOf(node));
    }
  }
  std::sort(seen.begin(), seen.end());
  std::vector<PointIndex> points;
  for (size_t i = 1; i < seen.size(); ++i) {
    if (seen[i] == seen[i - 1] && (points.empty() || points.back() != seen[i])) {
      points.push_back(seen[i]);
    }
  }
  return points;
}

}  // namespace

std::vector<ImageSlot> CovisibleWindow(const MappingState& state, ImageSlot image, int size) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<uint32_t> shared(graph.NumImages(), 0);
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    if (state.PointOf(node) == kNoPoint) continue;
    for (const Node other : state.Point(state.PointOf(node)).nodes) {
      ++shared[graph.image_of_node[other]];
    }
  }
  std::vector<ImageSlot> window;
  for (const ImageSlot other : state.Registered()) {
    if (other != image && shared[other] > 0) window.push_back(other);
  }
  std::sort(window.begin(), window.end(), [&](ImageSlot x, ImageSlot y) {
    return std::tuple(shared[y], x) < std::tuple(shared[x], y);
  });
  window.insert(window.begin(), image);
  if (window.size() > static_cast<size_t>(size)) window.resize(static_cast<size_t>(size));
  return window;
}

absl::Status AdjustLocally(MappingState& state,
                           ImageSlot image,
                           const MappingOptions& options,
                           const StageContext& context) {
  const BundleOptions how = {
      .loss = BundleLoss::kCauchy, .max_iterations = 10, .function_tolerance = 1e-3};
  const std::vector<ImageSlot> window = CovisibleWindow(state, image, options.local_window);
  DropNearPoints(state, window);
  const std::vector<PointIndex> points = PointsOfWindow(state, window);
  ORBWEAVE_RETURN_IF_ERROR(AdjustPart(state, window, points, how, context).status());
  CompleteTracks(state, points, options.max_error_px);
  MergePoints(state, points, options.max_error_px);
  FilterPoints(state, points, LimitsOf(options));
  return absl::OkStatus();
}

}  // namespace orbweave
