// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/level_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/positioning/upright.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr size_t kFewestPairs = 10;
constexpr double kMaxMedian_rad = 3.0 * kRadiansPerDegree;
constexpr double kLeastSigma_rad = kRadiansPerDegree;
/// Median of the length of two normal components, and two cameras.
constexpr double kMedianOfLeans = 1.1774 * std::numbers::sqrt2;
constexpr double kUprightCameras = 3.0;
/// Streets climb by five in a hundred, and hills by more; ten panoramas in a row climb alike, so
/// that each of them is worth a tenth of one.
constexpr double kSlopeSigma_rad = 3.0 * kRadiansPerDegree;
constexpr double kAlikeOnSlopes = 10.0;
constexpr double kLossSigmas = 3.0;
constexpr int kRounds = 5;

}  // namespace

std::optional<double> LevelSigma(const ClusterProblem& problem, const CorrespondenceGraph& graph) {
  std::vector<double> angles;
  for (const LinkedPair& pair : graph.pairs) {
    const Eigen::Quaterniond& b_from_a = problem.pairs[pair.index].b_from_a.rotation;
    angles.push_back(AngleBetween(b_from_a * Vector3d::UnitY(), Vector3d::UnitY()));
  }
  if (angles.size() < kFewestPairs) return std::nullopt;
  const double median = Quantile(angles, 0.5);
  if (median > kMaxMedian_rad) return std::nullopt;
  return std::max(kLeastSigma_rad, median / kMedianOfLeans);
}

MappingState LevelState(const ClusterProblem& problem,
                        const CorrespondenceGraph& graph,
                        const MappingOptions& options) {
  MappingState state(problem, graph);
  if (ScheduleOf(options).relaxes_registration) state.SetLevelSigma(LevelSigma(problem, graph));
  return state;
}

std::optional<LevelFrame> FindLevelFrame(const MappingState& state) {
  const auto upright = UprightFromWorld(state, state.Registered());
  if (!upright) return std::nullopt;
  LevelFrame frame{.up_in_world = upright->conjugate() * Vector3d::UnitZ()};
  for (int round = 0; round < kRounds; ++round) {
    frame.up_in_cam.clear();
    for (const ImageSlot image : state.Registered()) {
      Vector3d& sum = frame.up_in_cam
                          .try_emplace(state.Problem().images[image].drive,
                                       -kUprightCameras * Vector3d::UnitY())
                          .first->second;
      sum += state.CamFromWorld(image).rotation * frame.up_in_world;
    }
    for (auto& [drive, up] : frame.up_in_cam) up.normalize();
    Vector3d up_in_world = Vector3d::Zero();
    for (const ImageSlot image : state.Registered()) {
      up_in_world += state.CamFromWorld(image).rotation.conjugate() *
                     frame.up_in_cam.at(state.Problem().images[image].drive);
    }
    frame.up_in_world = up_in_world.normalized();
  }
  return frame;
}

void AddLevelPriors(const MappingState& state,
                    std::span<const ImageSlot> images,
                    BundleProblem& problem) {
  if (!state.LevelSigma()) return;
  const std::optional<LevelFrame> frame = FindLevelFrame(state);
  if (!frame) return;
  const double sigma_rad =
      std::hypot(*state.LevelSigma(), kSlopeSigma_rad * std::sqrt(kAlikeOnSlopes));
  for (uint32_t pose = 0; pose < images.size(); ++pose) {
    const ImageSlot image = images[pose];
    const Vector3d& up_in_cam = frame->up_in_cam.at(state.Problem().images[image].drive);
    const double lean =
        AngleBetween(state.CamFromWorld(image).rotation * frame->up_in_world, up_in_cam);
    const double far = lean / (kLossSigmas * sigma_rad);
    problem.direction_priors.push_back({.pose = pose,
                                        .direction_in_world = frame->up_in_world,
                                        .direction_in_cam = up_in_cam,
                                        .sigma_rad = sigma_rad * std::hypot(1.0, far)});
  }
}

}  // namespace orbweave
