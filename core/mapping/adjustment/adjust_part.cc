// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_part.h"

#include <algorithm>
#include <limits>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_problem.h"
#include "core/mapping/adjustment/level_cameras.h"

namespace orbweave {
namespace {

constexpr double kMinSigmaPx = 0.1;
/// So many sigmas off a position begins to lose weight; of those stated, where these are larger.
constexpr double kLossSigmas = 3.0;
constexpr uint32_t kNoPose = std::numeric_limits<uint32_t>::max();

/// Poses of the bundle problem: slots in order, and the inverse.
struct PoseTable {
  std::vector<ImageSlot> slots{};
  std::vector<uint32_t> pose_of_slot{};
};

void AddPose(const MappingState& state,
             ImageSlot image,
             bool is_fixed,
             PoseTable& table,
             BundleProblem& problem) {
  table.pose_of_slot[image] = static_cast<uint32_t>(table.slots.size());
  table.slots.push_back(image);
  problem.cams_from_world.push_back(state.CamFromWorld(image));
  problem.pose_is_fixed.push_back(is_fixed ? 1 : 0);
}

void AddPoint(const MappingState& state,
              PointIndex point,
              PoseTable& table,
              BundleProblem& problem) {
  const auto index = static_cast<uint32_t>(problem.points_in_world.size());
  problem.points_in_world.push_back(state.Point(point).position);
  for (const Node node : state.Point(point).nodes) {
    const ImageSlot image = state.Graph().image_of_node[node];
    if (table.pose_of_slot[image] == kNoPose) AddPose(state, image, true, table, problem);
    problem.observations.push_back({.pose = table.pose_of_slot[image],
                                    .point = index,
                                    .bearing = state.Graph().bearing_of_node[node],
                                    .sigma_rad = NodeSigma(state, node)});
  }
}

/// The poses of the problem begin with those of `images`.
void AddPositions(const MappingState& state,
                  std::span<const ImageSlot> images,
                  BundleProblem& problem) {
  for (uint32_t pose = 0; pose < images.size(); ++pose) {
    const PosePrior& prior = state.Problem().images[images[pose]].prior;
    if (!prior.position_in_enu) continue;
    const Eigen::Vector3d sigma_m = {
        prior.horizontal_sigma_m, prior.horizontal_sigma_m, prior.vertical_sigma_m};
    problem.position_priors.push_back(
        {.pose = pose,
         .position_in_world = state.PositionInWorld(images[pose]),
         .sigma_m = state.PositionFactor() * sigma_m,
         .loss_sigmas = kLossSigmas / std::min(1.0, state.PositionFactor())});
  }
}

}  // namespace

double NodeSigma(const MappingState& state, Node node) {
  const ClusterImage& image = state.Problem().images[state.Graph().image_of_node[node]];
  return std::max(static_cast<double>(image.sigma_rad[state.Graph().feature_of_node[node]]),
                  image.camera.AngleFromPixels(kMinSigmaPx));
}

absl::StatusOr<BundleReport> AdjustPart(MappingState& state,
                                        std::span<const ImageSlot> images,
                                        std::span<const PointIndex> points,
                                        const BundleOptions& options,
                                        const StageContext& context) {
  BundleProblem problem;
  PoseTable table;
  table.pose_of_slot.assign(state.Graph().NumImages(), kNoPose);
  for (const ImageSlot image : images) AddPose(state, image, false, table, problem);
  for (const PointIndex point : points) AddPoint(state, point, table, problem);

  if (state.IsInEnu()) AddPositions(state, images, problem);
  AddLevelPriors(state, images, problem);

  ORBWEAVE_ASSIGN_OR_RETURN(BundleReport report, AdjustBundle(problem, options, context));
  for (size_t i = 0; i < images.size(); ++i) state.SetPose(images[i], problem.cams_from_world[i]);
  for (size_t i = 0; i < points.size(); ++i) {
    state.SetPosition(points[i], problem.points_in_world[i]);
  }
  return report;
}

}  // namespace orbweave
