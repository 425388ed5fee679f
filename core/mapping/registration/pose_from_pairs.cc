// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pose_from_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/estimators/refine_between_views.h"
#include "core/geometry/rotation.h"
#include "core/mapping/registration/baseline_length.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxPairs = 5;
constexpr size_t kMaxLengths = 100;  ///< per pair that are tried
constexpr int kRefinementSteps = 20;
constexpr size_t kMaxExchanges = 64;
/// One image in 10,000 would be placed by chance, as for pairs (two_view.max_log10_false_alarms).
constexpr double kMaxLog10FalseAlarms = -4.0;
/// Directions are good to a degree: the centre is then good to a tenth of the baseline.
constexpr double kMinCrossingRad = 10.0 * std::numbers::pi / 180.0;

/// Where a pair says the image is: rotation, and the centre on a ray from the neighbour's.
struct PairHypothesis {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Vector3d neighbour_centre = Vector3d::Zero();
  Vector3d direction = Vector3d::Zero();  ///< unit; zero for a pure rotation
};

PairHypothesis HypothesisOf(const MappingState& state, ImageSlot image, const LinkedPair& pair) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  const ImageSlot neighbour = pair.Other(image);
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

/// Poses that the hypothesis and one scene point each determine.
void AddPosesOfPoints(const PairHypothesis& hypothesis,
                      const SceneCorrespondences& correspondences,
                      std::vector<Rigid3>& poses) {
  const Eigen::Quaterniond& R = hypothesis.cam_from_world;
  if (hypothesis.direction.isZero()) {
    poses.push_back(Rigid3::FromCentre(R, hypothesis.neighbour_centre));
    return;
  }
  const size_t stride = std::max<size_t>(1, correspondences.size() / kMaxLengths);
  for (size_t i = 0; i < correspondences.size(); i += stride) {
    const Vector3d v = R.conjugate() * correspondences.bearings[i];
    const double s = BaselineLength(
        correspondences.positions[i] - hypothesis.neighbour_centre, hypothesis.direction, v);
    if (s == 0.0) continue;
    poses.push_back(Rigid3::FromCentre(R, hypothesis.neighbour_centre + s * hypothesis.direction));
  }
}

/// The pose with the first one's rotation, its centre on that one's ray, nearest to the other's.
void AddPoseOfCrossing(const PairHypothesis& first,
                       const PairHypothesis& second,
                       std::vector<Rigid3>& poses) {
  const Vector3d normal = first.direction.cross(second.direction);
  if (normal.norm() < std::sin(kMinCrossingRad)) return;
  const Vector3d between = second.neighbour_centre - first.neighbour_centre;
  const double s = between.cross(second.direction).dot(normal) / normal.squaredNorm();
  const double t = between.cross(first.direction).dot(normal) / normal.squaredNorm();
  if (s <= 0.0 || t <= 0.0) return;
  poses.push_back(
      Rigid3::FromCentre(first.cam_from_world, first.neighbour_centre + s * first.direction));
}

std::vector<PairHypothesis> HypothesesOf(const MappingState& state, ImageSlot image) {
  std::vector<PairHypothesis> hypotheses;
  for (const uint32_t p : PairsWithRegistered(state, image)) {
    if (hypotheses.size() == kMaxPairs) break;
    hypotheses.push_back(HypothesisOf(state, image, state.Graph().pairs[p]));
  }
  return hypotheses;
}

std::vector<Rigid3> CandidatesOf(const std::vector<PairHypothesis>& hypotheses,
                                 const SceneCorrespondences& correspondences) {
  std::vector<Rigid3> poses;
  for (const PairHypothesis& first : hypotheses) {
    AddPosesOfPoints(first, correspondences, poses);
    for (const PairHypothesis& second : hypotheses) AddPoseOfCrossing(first, second, poses);
  }
  return poses;
}

std::optional<Rigid3> BestCandidate(const std::vector<Rigid3>& candidates,
                                    const SceneCorrespondences& correspondences,
                                    std::span<const ViewMatches> views,
                                    double max_error_rad) {
  std::optional<Rigid3> best;
  uint32_t most = 0;
  for (const Rigid3& candidate : candidates) {
    const uint32_t agreeing = SupportOf(candidate, correspondences, max_error_rad).count +
                              CountAgreeingMatches(candidate, views, max_error_rad);
    if (agreeing <= most) continue;
    most = agreeing;
    best = candidate;
  }
  return best;
}

Rigid3 Refine(const Rigid3& pose,
              const SceneCorrespondences& correspondences,
              std::span<const ViewMatches> views,
              double max_error_rad) {
  const PoseSupport near = SupportOf(pose, correspondences, kPairSlack * max_error_rad);
  std::vector<Vector3d> bearings;
  std::vector<Vector3d> positions;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    if (near.is_inlier[i] == 0) continue;
    bearings.push_back(correspondences.bearings[i]);
    positions.push_back(correspondences.positions[i]);
  }
  return MinimiseBetweenViews(
      pose, views, bearings, positions, 0.5 * max_error_rad, kRefinementSteps);
}

/// Share of exchanged correspondences, the ray of one and the point of another, that agree.
double ChanceShare(const Rigid3& cam_from_world,
                   const SceneCorrespondences& correspondences,
                   double max_error_rad) {
  const size_t n = correspondences.size();
  const size_t num_shifts = n == 0 ? 0 : std::min(n - 1, kMaxExchanges);
  size_t agreeing = 0;
  for (size_t shift = 1; shift <= num_shifts; ++shift) {
    for (size_t i = 0; i < n; ++i) {
      const Vector3d& position = correspondences.positions[(i + shift) % n];
      agreeing +=
          IsWithinAngle(cam_from_world * position, correspondences.bearings[i], max_error_rad) ? 1U
                                                                                               : 0U;
    }
  }
  return static_cast<double>(agreeing + 1) / static_cast<double>(num_shifts * n + 1);
}

double CrossingAngle(const Rigid3& cam_from_world,
                     std::span<const ViewMatches> views,
                     double max_error_rad) {
  std::vector<Vector3d> directions;
  for (const ViewMatches& view : views) {
    const uint32_t agreeing = CountAgreeingMatches(cam_from_world, {&view, 1}, max_error_rad);
    if (agreeing < kAgreeingPairShare * static_cast<double>(view.in_view.size())) continue;
    const Vector3d baseline = cam_from_world.Centre() - view.view_from_world.Centre();
    if (baseline.norm() > 0.0) directions.push_back(baseline.normalized());
  }
  double largest = 0.0;
  for (const Vector3d& first : directions) {
    for (const Vector3d& second : directions) {
      largest = std::max(largest, std::asin(std::min(1.0, first.cross(second).norm())));
    }
  }
  return largest;
}

}  // namespace

std::vector<Rigid3> PosesOfPairs(const MappingState& state,
                                 ImageSlot image,
                                 const SceneCorrespondences& correspondences) {
  return CandidatesOf(HypothesesOf(state, image), correspondences);
}

std::optional<PoseFromPairs> EstimatePoseFromPairs(const MappingState& state,
                                                   ImageSlot image,
                                                   std::span<const ViewMatches> views,
                                                   const SceneCorrespondences& correspondences,
                                                   double max_error_rad) {
  const std::vector<PairHypothesis> hypotheses = HypothesesOf(state, image);
  const std::optional<Rigid3> best = BestCandidate(CandidatesOf(hypotheses, correspondences),
                                                   correspondences,
                                                   views,
                                                   kPairSlack * max_error_rad);
  if (!best) return std::nullopt;
  PoseFromPairs found{.cam_from_world = Refine(*best, correspondences, views, max_error_rad)};
  found.points = SupportOf(found.cam_from_world, correspondences, max_error_rad);
  for (const ViewMatches& view : views)
    found.num_matches += static_cast<uint32_t>(view.in_view.size());
  found.agreeing_matches = CountAgreeingMatches(found.cam_from_world, views, max_error_rad);
  found.crossing_angle_rad = CrossingAngle(found.cam_from_world, views, max_error_rad);
  const Telling telling = CountTelling(found.cam_from_world,
                                       hypotheses.front().neighbour_centre,
                                       correspondences,
                                       views,
                                       max_error_rad);
  found.telling_matches = telling.matches;
  if (telling.points >= kFewestTelling) {
    found.log10_false_alarms =
        Log10FalseAlarms(correspondences.size(),
                         telling.points,
                         1,
                         ChanceShare(found.cam_from_world, correspondences, max_error_rad));
  }
  return found;
}

bool IsHeldByPairs(const PoseFromPairs& pose, uint32_t min_matches) {
  if (pose.agreeing_matches < min_matches ||
      pose.agreeing_matches < kAgreeingPairShare * pose.num_matches) {
    return false;
  }
  return pose.log10_false_alarms <= kMaxLog10FalseAlarms ||
         (pose.crossing_angle_rad >= kMinCrossingRad && 2 * pose.telling_matches >= min_matches);
}

}  // namespace orbweave
