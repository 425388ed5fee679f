// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/pose_from_pairs.h"

#include <algorithm>
#include <tuple>

#include "core/estimators/estimate_absolute_pose.h"

namespace orbweave {
namespace {

constexpr size_t kMaxPairs = 5;
/// Relative poses are less exact than adjusted ones: hypotheses are judged at this many thresholds.
constexpr double kSlack = 3.0;
constexpr double kMinSine = 0.02;

/// Pairs of `image` with registered images, strongest first.
std::vector<uint32_t> StrongestPairs(const MappingState& state, ImageSlot image) {
  std::vector<uint32_t> pairs;
  for (const uint32_t p : state.Graph().pairs_of_image[image]) {
    const LinkedPair& pair = state.Graph().pairs[p];
    if (state.IsRegistered(pair.a == image ? pair.b : pair.a)) pairs.push_back(p);
  }
  const auto matches = [&](uint32_t p) {
    return state.Problem().pairs[state.Graph().pairs[p].index].inliers.size();
  };
  std::sort(pairs.begin(), pairs.end(), [&](uint32_t x, uint32_t y) {
    return std::tuple(matches(y), x) < std::tuple(matches(x), y);
  });
  if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
  return pairs;
}

/// Where a pair says the image is: rotation, and the centre on a ray from the neighbour's.
struct PairHypothesis {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Eigen::Vector3d neighbour_centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit; zero for a pure rotation
};

PairHypothesis HypothesisOf(const MappingState& state, ImageSlot image, const LinkedPair& pair) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  const ImageSlot neighbour = pair.a == image ? pair.b : pair.a;
  const Rigid3 cam_from_neighbour =
      pair.a == image ? geometry.b_from_a.Inverse() : geometry.b_from_a;
  PairHypothesis hypothesis;
  hypothesis.cam_from_world =
      (cam_from_neighbour.rotation * state.CamFromWorld(neighbour).rotation).normalized();
  hypothesis.neighbour_centre = state.Centre(neighbour);
  if (geometry.kind != TwoViewKind::kPureRotation) {
    hypothesis.direction =
        -(hypothesis.cam_from_world.conjugate() * cam_from_neighbour.translation);
  }
  return hypothesis;
}

/// Poses that the hypothesis and one correspondence each determine.
std::vector<Rigid3> CandidatesOf(const PairHypothesis& hypothesis,
                                 const SceneCorrespondences& correspondences) {
  const Eigen::Quaterniond& R = hypothesis.cam_from_world;
  if (hypothesis.direction.isZero()) return {Rigid3::FromCentre(R, hypothesis.neighbour_centre)};
  std::vector<Rigid3> candidates;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    const Eigen::Vector3d v = R.conjugate() * correspondences.bearings[i];
    const Eigen::Vector3d d_cross_v = hypothesis.direction.cross(v);
    if (d_cross_v.norm() < kMinSine) continue;
    const Eigen::Vector3d to_point = correspondences.positions[i] - hypothesis.neighbour_centre;
    const double s = to_point.cross(v).dot(d_cross_v) / d_cross_v.squaredNorm();
    if (s <= 0.0) continue;
    candidates.push_back(
        Rigid3::FromCentre(R, hypothesis.neighbour_centre + s * hypothesis.direction));
  }
  return candidates;
}

}  // namespace

std::optional<Rigid3> EstimatePoseFromPairs(const MappingState& state,
                                            ImageSlot image,
                                            const SceneCorrespondences& correspondences,
                                            double max_error_rad) {
  std::optional<Rigid3> best;
  PoseSupport best_support;
  for (const uint32_t p : StrongestPairs(state, image)) {
    const PairHypothesis hypothesis = HypothesisOf(state, image, state.Graph().pairs[p]);
    for (const Rigid3& candidate : CandidatesOf(hypothesis, correspondences)) {
      PoseSupport support = SupportOf(candidate, correspondences, kSlack * max_error_rad);
      if (support.count > best_support.count) {
        best = candidate;
        best_support = std::move(support);
      }
    }
  }
  constexpr uint32_t kMinimal = 4;
  if (!best || best_support.count < kMinimal) return std::nullopt;
  return RefineAbsolutePose(*best,
                            correspondences.bearings,
                            correspondences.positions,
                            best_support.is_inlier,
                            max_error_rad);
}

}  // namespace orbweave
