// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/pose_from_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/bundle/bearing_error.h"
#include "core/estimators/refine_between_views.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/rotation.h"
#include "core/mapping/baseline_length.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxPairs = 5;
/// Relative poses are less exact than adjusted ones: hypotheses are judged at this many thresholds.
constexpr double kSlack = 3.0;
constexpr size_t kMaxLengths = 100;  ///< per pair that are tried
constexpr int kRefinementSteps = 20;
constexpr size_t kMaxExchanges = 64;
/// The matches of a pair that agrees. Wrong matches agree with a pose by 1 in 100 only.
constexpr double kAgreeingShare = 0.5;
/// One image in 10,000 would be placed by chance, as for pairs (two_view.max_log10_false_alarms).
constexpr double kMaxLog10FalseAlarms = -4.0;
constexpr uint32_t kFewestPoints = 4;
/// Directions are good to a degree: the centre is then good to a tenth of the baseline.
constexpr double kMinCrossingRad = 10.0 * std::numbers::pi / 180.0;

/// Pairs of `image` with registered images, strongest first.
std::vector<uint32_t> PairsByStrength(const MappingState& state, ImageSlot image) {
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
  return pairs;
}

ViewMatches MatchesOf(const MappingState& state, ImageSlot image, const LinkedPair& pair) {
  const CorrespondenceGraph& graph = state.Graph();
  const ImageSlot view = pair.a == image ? pair.b : pair.a;
  ViewMatches matches{.view_from_world = state.CamFromWorld(view)};
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Vector3d& a = graph.bearing_of_node[graph.node_of_feature[pair.a][match.a]];
    const Vector3d& b = graph.bearing_of_node[graph.node_of_feature[pair.b][match.b]];
    matches.in_view.push_back(pair.a == image ? b : a);
    matches.in_image.push_back(pair.a == image ? a : b);
  }
  return matches;
}

/// Where a pair says the image is: rotation, and the centre on a ray from the neighbour's.
struct PairHypothesis {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Vector3d neighbour_centre = Vector3d::Zero();
  Vector3d direction = Vector3d::Zero();  ///< unit; zero for a pure rotation
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

std::vector<Rigid3> CandidatesOf(const std::vector<PairHypothesis>& hypotheses,
                                 const SceneCorrespondences& correspondences) {
  std::vector<Rigid3> poses;
  for (const PairHypothesis& first : hypotheses) {
    AddPosesOfPoints(first, correspondences, poses);
    for (const PairHypothesis& second : hypotheses) AddPoseOfCrossing(first, second, poses);
  }
  return poses;
}

uint32_t CountAgreeing(const Rigid3& cam_from_world,
                       const ViewMatches& matches,
                       double max_error_rad) {
  Rigid3 cam_from_view = cam_from_world * matches.view_from_world.Inverse();
  if (!(cam_from_view.translation.norm() > 0.0)) return 0;
  cam_from_view.translation.normalize();
  const double min_cos_far = std::cos(2.0 * max_error_rad);
  uint32_t count = 0;
  for (size_t i = 0; i < matches.in_view.size(); ++i) {
    const Vector3d& a = matches.in_view[i];
    const Vector3d& b = matches.in_image[i];
    if (!(SymmetricEpipolarAngle(cam_from_view, a, b) <= max_error_rad)) continue;
    const bool is_far = b.dot(cam_from_view.rotation * a) > min_cos_far;
    count += is_far || IsInFrontOfBoth(cam_from_view, a, b) ? 1U : 0U;
  }
  return count;
}

uint32_t CountAgreeing(const Rigid3& cam_from_world,
                       const std::vector<ViewMatches>& views,
                       double max_error_rad) {
  uint32_t count = 0;
  for (const ViewMatches& view : views) count += CountAgreeing(cam_from_world, view, max_error_rad);
  return count;
}

std::optional<Rigid3> BestCandidate(const std::vector<Rigid3>& candidates,
                                    const SceneCorrespondences& correspondences,
                                    const std::vector<ViewMatches>& views,
                                    double max_error_rad) {
  std::optional<Rigid3> best;
  uint32_t most = 0;
  for (const Rigid3& candidate : candidates) {
    const uint32_t agreeing = SupportOf(candidate, correspondences, max_error_rad).count +
                              CountAgreeing(candidate, views, max_error_rad);
    if (agreeing <= most) continue;
    most = agreeing;
    best = candidate;
  }
  return best;
}

Rigid3 Refine(const Rigid3& pose,
              const SceneCorrespondences& correspondences,
              const std::vector<ViewMatches>& views,
              double max_error_rad) {
  const PoseSupport near = SupportOf(pose, correspondences, kSlack * max_error_rad);
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
          BearingError(cam_from_world, position, correspondences.bearings[i]) <= max_error_rad ? 1U
                                                                                               : 0U;
    }
  }
  return static_cast<double>(agreeing + 1) / static_cast<double>(num_shifts * n + 1);
}

/// What agrees with this length of the baseline from the strongest pair's image beyond what would
/// with half or twice of it: what is far, or seen from that image alone, agrees with every length.
struct Telling {
  uint32_t points = 0;
  uint32_t matches = 0;
};

Telling CountTelling(const Rigid3& cam_from_world,
                     const Vector3d& neighbour_centre,
                     const SceneCorrespondences& correspondences,
                     const std::vector<ViewMatches>& views,
                     double max_error_rad) {
  const auto agreeing = [&](double factor) {
    const Vector3d centre =
        neighbour_centre + factor * (cam_from_world.Centre() - neighbour_centre);
    const Rigid3 moved = Rigid3::FromCentre(cam_from_world.rotation, centre);
    return Telling{SupportOf(moved, correspondences, max_error_rad).count,
                   CountAgreeing(moved, views, max_error_rad)};
  };
  const Telling here = agreeing(1.0);
  const Telling half = agreeing(0.5);
  const Telling twice = agreeing(2.0);
  return {here.points - std::min(here.points, std::max(half.points, twice.points)),
          here.matches - std::min(here.matches, std::max(half.matches, twice.matches))};
}

double CrossingAngle(const Rigid3& cam_from_world,
                     const std::vector<ViewMatches>& views,
                     double max_error_rad) {
  std::vector<Vector3d> directions;
  for (const ViewMatches& view : views) {
    const uint32_t agreeing = CountAgreeing(cam_from_world, view, max_error_rad);
    if (agreeing < kAgreeingShare * static_cast<double>(view.in_view.size())) continue;
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

/// How many of a pair's matches show parallax, and how many of those agree.
struct NearMatches {
  uint32_t all = 0;
  uint32_t agreeing = 0;
};

NearMatches CountNear(const Rigid3& cam_from_world,
                      const ViewMatches& matches,
                      double max_error_rad) {
  Rigid3 cam_from_view = cam_from_world * matches.view_from_world.Inverse();
  cam_from_view.translation.normalize();
  const double min_cos_far = std::cos(2.0 * max_error_rad);
  NearMatches near;
  for (size_t i = 0; i < matches.in_view.size(); ++i) {
    const Vector3d& a = matches.in_view[i];
    const Vector3d& b = matches.in_image[i];
    if (b.dot(cam_from_view.rotation * a) > min_cos_far) continue;
    ++near.all;
    const bool agrees = SymmetricEpipolarAngle(cam_from_view, a, b) <= max_error_rad &&
                        IsInFrontOfBoth(cam_from_view, a, b);
    near.agreeing += agrees ? 1U : 0U;
  }
  return near;
}

std::vector<ViewMatches> ViewsOf(const MappingState& state, ImageSlot image) {
  std::vector<ViewMatches> views;
  for (const uint32_t p : PairsByStrength(state, image)) {
    const LinkedPair& pair = state.Graph().pairs[p];
    if (state.Problem().pairs[pair.index].kind != TwoViewKind::kPureRotation)
      views.push_back(MatchesOf(state, image, pair));  // others have no planes
  }
  return views;
}

}  // namespace

bool ContradictsStrongPair(const MappingState& state,
                           ImageSlot image,
                           const Rigid3& cam_from_world,
                           double max_error_rad) {
  const std::vector<ViewMatches> views = ViewsOf(state, image);
  return std::ranges::any_of(views, [&](const ViewMatches& view) {
    if (2 * view.in_view.size() < views.front().in_view.size()) return false;
    const NearMatches near = CountNear(cam_from_world, view, kSlack * max_error_rad);
    return near.agreeing < kAgreeingShare * near.all;
  });
}

uint32_t CountAgreeingMatches(const MappingState& state,
                              ImageSlot image,
                              const Rigid3& cam_from_world,
                              double max_error_rad) {
  return CountAgreeing(cam_from_world, ViewsOf(state, image), max_error_rad);
}

bool IsLengthTold(const MappingState& state,
                  ImageSlot image,
                  const Rigid3& cam_from_world,
                  const SceneCorrespondences& correspondences,
                  double max_error_rad) {
  const std::vector<ViewMatches> views = ViewsOf(state, image);
  if (views.empty()) return true;
  const Telling telling = CountTelling(cam_from_world,
                                       views.front().view_from_world.Centre(),
                                       correspondences,
                                       views,
                                       max_error_rad);
  return telling.points + telling.matches >= kFewestPoints;
}

std::optional<PoseFromPairs> EstimatePoseFromPairs(const MappingState& state,
                                                   ImageSlot image,
                                                   const SceneCorrespondences& correspondences,
                                                   double max_error_rad) {
  const std::vector<ViewMatches> views = ViewsOf(state, image);
  std::vector<PairHypothesis> hypotheses;
  for (const uint32_t p : PairsByStrength(state, image)) {
    if (hypotheses.size() == kMaxPairs) break;
    hypotheses.push_back(HypothesisOf(state, image, state.Graph().pairs[p]));
  }
  const std::optional<Rigid3> best = BestCandidate(
      CandidatesOf(hypotheses, correspondences), correspondences, views, kSlack * max_error_rad);
  if (!best) return std::nullopt;
  PoseFromPairs found{.cam_from_world = Refine(*best, correspondences, views, max_error_rad)};
  found.points = SupportOf(found.cam_from_world, correspondences, max_error_rad);
  for (const ViewMatches& view : views)
    found.num_matches += static_cast<uint32_t>(view.in_view.size());
  found.agreeing_matches = CountAgreeing(found.cam_from_world, views, max_error_rad);
  found.crossing_angle_rad = CrossingAngle(found.cam_from_world, views, max_error_rad);
  const Telling telling = CountTelling(found.cam_from_world,
                                       hypotheses.front().neighbour_centre,
                                       correspondences,
                                       views,
                                       max_error_rad);
  found.telling_matches = telling.matches;
  if (telling.points >= kFewestPoints) {
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
      pose.agreeing_matches < kAgreeingShare * pose.num_matches) {
    return false;
  }
  return pose.log10_false_alarms <= kMaxLog10FalseAlarms ||
         (pose.crossing_angle_rad >= kMinCrossingRad && 2 * pose.telling_matches >= min_matches);
}

}  // namespace orbweave
