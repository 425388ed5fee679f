// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/bridge_terms.h"

#include <utility>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/mapping/registration/baseline_length.h"

namespace orbweave {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr size_t kFewestLengths = 5;

/// The two nodes of a match: in the image of a, in that of b.
struct BridgeMatch {
  Node in_a = 0;
  Node in_b = 0;
};

std::vector<BridgeMatch> MatchesOf(const MappingState& state, const BridgePair& bridge) {
  const CorrespondenceGraph& graph = state.Graph();
  const LinkedPair& pair = graph.pairs[bridge.pair];
  std::vector<BridgeMatch> matches;
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node first = graph.node_of_feature[pair.a][match.a];
    const Node second = graph.node_of_feature[pair.b][match.b];
    matches.push_back(pair.a == bridge.in_a ? BridgeMatch{first, second}
                                            : BridgeMatch{second, first});
  }
  return matches;
}

double MedianLength(std::vector<double>& lengths) {
  std::erase(lengths, 0.0);
  if (lengths.size() < kFewestLengths) return 0.0;
  return UpperMedian(lengths);
}

void AddSights(const MappingState& a,
               const MappingState& b,
               const BridgePair& bridge,
               const Vector3d& origin_in_b,
               double max_error_px,
               BridgeTerms& terms) {
  const Rigid3& cam_from_a = a.CamFromWorld(bridge.in_a);
  const Rigid3 cam_from_b =
      Rigid3::FromCentre(b.CamFromWorld(bridge.in_b).rotation, b.Centre(bridge.in_b) - origin_in_b);
  const CorrespondenceGraph& graph = a.Graph();
  for (const BridgeMatch& match : MatchesOf(a, bridge)) {
    const double sigma_rad = AngleFromPixels(a, match.in_a, max_error_px);
    if (const PointIndex point = a.PointOf(match.in_a); point != kNoPoint) {
      terms.from_b.push_back({.cam_from_own = cam_from_b,
                              .point_in_other = a.Point(point).position,
                              .bearing = graph.bearing_of_node[match.in_b],
                              .sigma_rad = sigma_rad});
    }
    if (const PointIndex point = b.PointOf(match.in_b); point != kNoPoint) {
      terms.from_a.push_back({.cam_from_own = cam_from_a,
                              .point_in_other = b.Point(point).position - origin_in_b,
                              .bearing = graph.bearing_of_node[match.in_a],
                              .sigma_rad = sigma_rad});
    }
  }
}

void AddFixes(const MappingState& b,
              std::span<const ImageSlot> images,
              const Vector3d& origin_in_b,
              BridgeTerms& terms) {
  for (const ImageSlot image : images) {
    const PosePrior& prior = b.Problem().images[image].prior;
    if (!prior.position_in_enu) continue;
    terms.fixes.push_back(
        {.centre_in_b = b.Centre(image) - origin_in_b,
         .position_in_enu = *prior.position_in_enu,
         .sigma_m = {prior.horizontal_sigma_m, prior.horizontal_sigma_m, prior.vertical_sigma_m}});
  }
}

}  // namespace

std::vector<BridgePair> BridgePairsOf(const MappingState& a, const MappingState& b) {
  std::vector<BridgePair> bridges;
  const CorrespondenceGraph& graph = a.Graph();
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    const LinkedPair& pair = graph.pairs[p];
    const bool is_straight = a.IsRegistered(pair.a) && b.IsRegistered(pair.b);
    if (!is_straight && !(a.IsRegistered(pair.b) && b.IsRegistered(pair.a))) continue;
    const TwoViewGeometry& geometry = a.Problem().pairs[pair.index];
    const Rigid3 cam_b_from_cam_a = is_straight ? geometry.b_from_a : geometry.b_from_a.Inverse();
    BridgePair bridge{.pair = p,
                      .in_a = is_straight ? pair.a : pair.b,
                      .in_b = is_straight ? pair.b : pair.a,
                      .matches = geometry.inliers.size()};
    bridge.a_from_b =
        ((cam_b_from_cam_a.rotation * a.CamFromWorld(bridge.in_a).rotation).conjugate() *
         b.CamFromWorld(bridge.in_b).rotation)
            .normalized();
    if (geometry.kind != TwoViewKind::kPureRotation)
      bridge.direction_in_cam_a = cam_b_from_cam_a.Centre().normalized();
    bridges.push_back(bridge);
  }
  return bridges;
}

std::vector<BridgePair> PairsThatTurnAlike(const std::vector<BridgePair>& pairs,
                                           double max_turn_rad) {
  std::vector<BridgePair> best;
  size_t most = 0;
  for (const BridgePair& centre : pairs) {
    std::vector<BridgePair> alike;
    size_t matches = 0;
    for (const BridgePair& each : pairs) {
      if (RotationAngle(centre.a_from_b.conjugate() * each.a_from_b) > max_turn_rad) continue;
      alike.push_back(each);
      matches += each.matches;
    }
    if (matches <= most) continue;
    most = matches;
    best = std::move(alike);
  }
  return best;
}

BridgeTerms TermsOf(const MappingState& a,
                    const MappingState& b,
                    const std::vector<BridgePair>& pairs,
                    const Vector3d& origin_in_b,
                    std::span<const ImageSlot> fixed,
                    const std::optional<Sim3>& enu_from_a,
                    std::optional<double> max_error_px) {
  BridgeTerms terms{.b_is_one_camera = b.Registered().size() == 1};
  for (const BridgePair& bridge : pairs) {
    terms.turns.push_back({bridge.a_from_b, kTurnSigmaRad});
    if (bridge.direction_in_cam_a.isZero()) continue;
    terms.from_a.push_back({.cam_from_own = a.CamFromWorld(bridge.in_a),
                            .point_in_other = b.Centre(bridge.in_b) - origin_in_b,
                            .bearing = bridge.direction_in_cam_a,
                            .sigma_rad = kDirectionSigmaRad});
    if (max_error_px) AddSights(a, b, bridge, origin_in_b, *max_error_px, terms);
  }
  if (!enu_from_a) return terms;
  terms.enu_from_a = *enu_from_a;
  AddFixes(b, fixed, origin_in_b, terms);
  return terms;
}

BridgeLengths LengthsOf(const MappingState& a, const MappingState& b, const BridgePair& bridge) {
  if (bridge.direction_in_cam_a.isZero()) return {};
  const CorrespondenceGraph& graph = a.Graph();
  const Rigid3& cam_a = a.CamFromWorld(bridge.in_a);
  const Rigid3& cam_b = b.CamFromWorld(bridge.in_b);
  const Vector3d towards_b = cam_a.rotation.conjugate() * bridge.direction_in_cam_a;
  const Vector3d towards_a = -(bridge.a_from_b.conjugate() * towards_b);
  std::vector<double> in_a;
  std::vector<double> in_b;
  for (const BridgeMatch& match : MatchesOf(a, bridge)) {
    if (const PointIndex point = a.PointOf(match.in_a); point != kNoPoint) {
      const Vector3d ray =
          bridge.a_from_b * (cam_b.rotation.conjugate() * graph.bearing_of_node[match.in_b]);
      in_a.push_back(BaselineLength(a.Point(point).position - cam_a.Centre(), towards_b, ray));
    }
    if (const PointIndex point = b.PointOf(match.in_b); point != kNoPoint) {
      const Vector3d ray = bridge.a_from_b.conjugate() *
                           (cam_a.rotation.conjugate() * graph.bearing_of_node[match.in_a]);
      in_b.push_back(BaselineLength(b.Point(point).position - cam_b.Centre(), towards_a, ray));
    }
  }
  return {MedianLength(in_a), MedianLength(in_b)};
}

}  // namespace orbweave
