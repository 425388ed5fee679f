// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_new_images.h"

#include <algorithm>
#include <vector>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_problem.h"
#include "core/mapping/adjustment/adjust_part.h"
#include "core/mapping/model/complete_tracks.h"
#include "core/mapping/model/filter_points.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/merge_points.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {
namespace {

constexpr BundleOptions kHow = {.max_iterations = 10, .function_tolerance = 1e-3};

/// Ascending.
std::vector<PointIndex> PointsSeenBy(const MappingState& state, std::span<const ImageSlot> images) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<PointIndex> points;
  for (const ImageSlot image : images) {
    for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
      if (state.PointOf(node) != kNoPoint) points.push_back(state.PointOf(node));
    }
  }
  std::ranges::sort(points);
  points.erase(std::ranges::unique(points).begin(), points.end());
  return points;
}

}  // namespace

absl::Status AdjustPose(MappingState& state,
                        ImageSlot image,
                        const MappingOptions& options,
                        const StageContext& context) {
  const SceneCorrespondences seen = FindSceneCorrespondences(state, image);
  const PoseSupport support =
      SupportOf(state.CamFromWorld(image),
                seen,
                state.Problem().images[image].camera.AngleFromPixels(options.max_error_px));
  BundleProblem problem{.cams_from_world = {state.CamFromWorld(image)}};
  for (size_t i = 0; i < seen.size(); ++i) {
    if (support.is_inlier[i] == 0) continue;
    problem.observations.push_back({.point = static_cast<uint32_t>(problem.points_in_world.size()),
                                    .bearing = seen.bearings[i],
                                    .sigma_rad = NodeSigma(state, seen.nodes[i])});
    problem.points_in_world.push_back(seen.positions[i]);
  }
  if (problem.observations.empty()) return absl::OkStatus();
  problem.point_is_fixed.assign(problem.points_in_world.size(), 1);
  ORBWEAVE_RETURN_IF_ERROR(AdjustBundle(problem, AsPresetAdjusts(options, kHow), context).status());
  state.SetPose(image, problem.cams_from_world.front());
  return absl::OkStatus();
}

absl::Status AdjustNewImages(MappingState& state,
                             std::span<const ImageSlot> images,
                             const MappingOptions& options,
                             const StageContext& context) {
  const std::vector<PointIndex> points = PointsSeenBy(state, images);
  ORBWEAVE_RETURN_IF_ERROR(
      AdjustPart(state, images, points, AsPresetAdjusts(options, kHow), context).status());
  CompleteTracks(state, points, options.max_error_px);
  MergePoints(state, points, options.max_error_px);
  FilterPoints(state, points, LimitsOf(options));
  return absl::OkStatus();
}

}  // namespace orbweave
