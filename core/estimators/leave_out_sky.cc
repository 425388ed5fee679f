// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/leave_out_sky.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/estimators/resolve_cheirality.h"
#include "core/estimators/sky_drift.h"
#include "core/estimators/split_by_height.h"
#include "core/estimators/two_view_inliers.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxDrift_rad = 0.087;  // half a degree a second for ten seconds
constexpr double kFarBaselines = 5.0;    // houses lie within five steps of 5 m across a street
constexpr double kStanding = 0.9;        // of what is far and high: no clouds, then
constexpr double kNotedShare = 0.1;      // of the inliers: less sky does no harm
constexpr int kRounds = 3;

/// What may not be sky of those that agree with a pose.
std::vector<uint32_t> Low(const BearingPairs& pairs, const Rigid3& b_from_a, double max_error_rad) {
  return WithoutSky(pairs, InliersOf(pairs, b_from_a, max_error_rad), b_from_a, max_error_rad);
}

/// From inliers that may not be sky and the pose that all had: the pose of these, and those of that
/// pose, in turns until no more come. The sky has drawn both along, so that fewer agree at first.
ResolvedPose RefineBelowSky(const BearingPairs& pairs, ResolvedPose below, double max_error_rad) {
  for (int round = 0; round < kRounds && !below.inliers.empty(); ++round) {
    const Rigid3 pose = RefinePose(pairs, below.inliers, below.b_from_a, max_error_rad);
    std::vector<uint32_t> inliers = Low(pairs, pose, max_error_rad);
    if (round > 0 && inliers.size() <= below.inliers.size()) break;
    below = {pose, std::move(inliers)};
  }
  return below;
}

/// Whether what may be sky of `putative` matches stands still beside the scene.
bool StandsStill(const MatchedBearings& bearings,
                 std::span<const FeatureMatch> putative,
                 const TwoViewGeometry& scene,
                 const BearingPairs& of_scene) {
  std::vector<FeatureMatch> sky;
  std::ranges::copy_if(putative, std::back_inserter(sky), [&](const FeatureMatch& match) {
    return MayBeSky(bearings, match, scene);
  });
  const BearingPairs far = bearings.Arranged(sky);
  return static_cast<double>(bearings.Agreeing(far, scene).size()) >=
             kStanding * static_cast<double>(far.Size()) &&
         !MeasureSkyDrift(far, of_scene, scene.b_from_a, bearings.max_error_rad).IsClear();
}

}  // namespace

bool MayBeSky(const MatchedBearings& bearings,
              const FeatureMatch& match,
              const TwoViewGeometry& geometry) {
  const Vector3d& a = bearings.a[match.a];
  const Vector3d& b = bearings.b[match.b];
  return IsEitherHigh(a, b) && AngleBetween(geometry.b_from_a.rotation * a, b) < kMaxDrift_rad;
}

std::vector<FeatureMatch> SkyOf(const MatchedBearings& bearings, const TwoViewGeometry& geometry) {
  if (geometry.kind == TwoViewKind::kPureRotation)
    return SplitByHeight(bearings.a, bearings.b, geometry.inliers).high;
  std::vector<FeatureMatch> sky;
  for (const FeatureMatch& match : geometry.inliers) {
    const Vector3d& a = bearings.a[match.a];
    const Vector3d& b = bearings.b[match.b];
    if (IsEitherHigh(a, b) && InverseDepth(a, b, geometry.b_from_a) < 1.0 / kFarBaselines)
      sky.push_back(match);
  }
  return sky;
}

TwoViewGeometry LeaveOutSky(const MatchedBearings& bearings,
                            TwoViewGeometry geometry,
                            std::span<const FeatureMatch> putative,
                            int min_inliers) {
  if (geometry.kind == TwoViewKind::kNone || geometry.kind == TwoViewKind::kPureRotation)
    return geometry;
  const double max_error_rad = bearings.max_error_rad;
  const auto fewest = static_cast<size_t>(min_inliers);
  const auto most = (1.0 - kNotedShare) * static_cast<double>(geometry.inliers.size());
  const BearingPairs pairs = bearings.Arranged(putative);
  ResolvedPose below{geometry.b_from_a, Low(pairs, geometry.b_from_a, max_error_rad)};
  if (below.inliers.size() < fewest || static_cast<double>(below.inliers.size()) > most)
    return geometry;
  below = RefineBelowSky(pairs, std::move(below), max_error_rad);
  if (below.inliers.size() < fewest) return geometry;
  const BearingPairs inliers = Subset(pairs, below.inliers);
  TwoViewGeometry scene = geometry;
  scene.b_from_a = below.b_from_a;
  if (StandsStill(bearings, putative, scene, inliers)) return geometry;
  SetInliers(inliers, putative, scene);
  return scene;
}

}  // namespace orbweave
