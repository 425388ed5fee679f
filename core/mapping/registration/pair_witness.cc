// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pair_witness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/geometry/epipolar.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Of a pair's matches: where a camera stood between two pictures those with parallax are what
/// moved, and a street is not mostly traffic; of two that stand apart most have it.
constexpr double kTellingParallax = 0.1;

ViewMatches MatchesOf(const MappingState& state, ImageSlot image, const LinkedPair& pair) {
  const CorrespondenceGraph& graph = state.Graph();
  const ImageSlot view = pair.Other(image);
  ViewMatches matches{.view_from_world = state.CamFromWorld(view)};
  const std::vector<FeatureMatch>& inliers = state.Problem().pairs[pair.index].inliers;
  matches.in_view.reserve(inliers.size());
  matches.in_image.reserve(inliers.size());
  for (const FeatureMatch& match : inliers) {
    const Vector3d& a = graph.bearing_of_node[graph.node_of_feature[pair.a][match.a]];
    const Vector3d& b = graph.bearing_of_node[graph.node_of_feature[pair.b][match.b]];
    matches.in_view.push_back(pair.a == image ? b : a);
    matches.in_image.push_back(pair.a == image ? a : b);
  }
  return matches;
}

/// Matches of one pair that show parallax under a pose, and those that agree with it.
struct MatchCount {
  uint32_t near = 0;
  uint32_t near_agreeing = 0;
  uint32_t far_agreeing = 0;
};

/// Nothing agrees with a pose in the same place. Not all are counted once `enough` of those with
/// parallax agree.
MatchCount CountMatches(const Rigid3& cam_from_world,
                        const ViewMatches& matches,
                        double max_error_rad,
                        double enough = std::numeric_limits<double>::infinity()) {
  Rigid3 cam_from_view = cam_from_world * matches.view_from_world.Inverse();
  const bool has_baseline = cam_from_view.translation.norm() > 0.0;
  cam_from_view.translation.normalize();
  const PoseOfRays rays_of(cam_from_view);
  const double min_cos_far = std::cos(2.0 * max_error_rad);
  MatchCount count;
  for (size_t i = 0; i < matches.in_view.size() && count.near_agreeing < enough; ++i) {
    const RayPair rays = rays_of(matches.in_view[i], matches.in_image[i]);
    const bool is_far = rays.cosine > min_cos_far;
    count.near += is_far ? 0U : 1U;
    if (!has_baseline || !rays.IsWithin(max_error_rad)) continue;
    if (is_far) {
      ++count.far_agreeing;
    } else if (rays.IsInFrontOfBoth()) {
      ++count.near_agreeing;
    }
  }
  return count;
}

}  // namespace

std::vector<uint32_t> PairsWithRegistered(const MappingState& state, ImageSlot image) {
  std::vector<uint32_t> pairs;
  for (const uint32_t p : state.Graph().pairs_of_image[image]) {
    const LinkedPair& pair = state.Graph().pairs[p];
    if (state.IsRegistered(pair.Other(image))) pairs.push_back(p);
  }
  const auto matches = [&](uint32_t p) {
    return state.Problem().pairs[state.Graph().pairs[p].index].inliers.size();
  };
  std::sort(pairs.begin(), pairs.end(), [&](uint32_t x, uint32_t y) {
    return std::tuple(matches(y), x) < std::tuple(matches(x), y);
  });
  return pairs;
}

std::vector<ViewMatches> MatchesWithRegistered(const MappingState& state, ImageSlot image) {
  std::vector<ViewMatches> views;
  for (const uint32_t p : PairsWithRegistered(state, image)) {
    const LinkedPair& pair = state.Graph().pairs[p];
    if (state.Problem().pairs[pair.index].kind != TwoViewKind::kPureRotation)
      views.push_back(MatchesOf(state, image, pair));
  }
  return views;
}

uint32_t CountAgreeingMatches(const Rigid3& cam_from_world,
                              std::span<const ViewMatches> views,
                              double max_error_rad) {
  uint32_t agreeing = 0;
  for (const ViewMatches& view : views) {
    const MatchCount count = CountMatches(cam_from_world, view, max_error_rad);
    agreeing += count.near_agreeing + count.far_agreeing;
  }
  return agreeing;
}

bool ContradictsStrongPair(const Rigid3& cam_from_world,
                           std::span<const ViewMatches> views,
                           double max_error_rad) {
  return std::ranges::any_of(views, [&](const ViewMatches& view) {
    if (2 * view.in_view.size() < views.front().in_view.size()) return false;
    const auto num_matches = static_cast<double>(view.in_view.size());
    const MatchCount count = CountMatches(
        cam_from_world, view, kPairSlack * max_error_rad, kAgreeingPairShare * num_matches);
    return count.near >= kTellingParallax * num_matches &&
           count.near_agreeing < kAgreeingPairShare * count.near;
  });
}

Telling CountTelling(const Rigid3& cam_from_world,
                     const Vector3d& neighbour_centre,
                     const SceneCorrespondences& correspondences,
                     std::span<const ViewMatches> views,
                     double max_error_rad) {
  const auto agreeing = [&](double factor) {
    const Vector3d centre =
        neighbour_centre + factor * (cam_from_world.Centre() - neighbour_centre);
    const Rigid3 moved = Rigid3::FromCentre(cam_from_world.rotation, centre);
    return Telling{SupportOf(moved, correspondences, max_error_rad).count,
                   CountAgreeingMatches(moved, views, max_error_rad)};
  };
  const Telling here = agreeing(1.0);
  const Telling half = agreeing(0.5);
  const Telling twice = agreeing(2.0);
  return {here.points - std::min(here.points, std::max(half.points, twice.points)),
          here.matches - std::min(here.matches, std::max(half.matches, twice.matches))};
}

bool IsLengthTold(const Rigid3& cam_from_world,
                  const SceneCorrespondences& correspondences,
                  std::span<const ViewMatches> views,
                  double max_error_rad) {
  if (views.empty()) return true;
  const Telling telling = CountTelling(cam_from_world,
                                       views.front().view_from_world.Centre(),
                                       correspondences,
                                       views,
                                       max_error_rad);
  return telling.points + telling.matches >= kFewestTelling;
}

}  // namespace orbweave
