// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/split_by_height.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// y points down.
Vector3d AtElevation(double elevation_deg, double azimuth_rad = 0.3) {
  const double e = elevation_deg * std::numbers::pi / 180.0;
  return {std::cos(e) * std::sin(azimuth_rad), -std::sin(e), std::cos(e) * std::cos(azimuth_rad)};
}

/// From a camera that goes one unit along z.
const Rigid3 kStep = {Eigen::Quaterniond::Identity(), Vector3d(0.0, 0.0, -1.0)};

BearingPairs PairsOf(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < points.size(); ++i) {
    a.push_back(points[i].normalized());
    b.push_back((kStep * points[i]).normalized());
    matches.push_back({i, i});
  }
  return ArrangePairs(a, b, matches, 1);
}

/// Indices of points among those kept.
std::vector<uint32_t> KeptOf(const std::vector<Vector3d>& points, double max_error_rad) {
  const BearingPairs pairs = PairsOf(points);
  std::vector<uint32_t> kept;
  for (const uint32_t i : WithoutSky(pairs, AllOf(pairs), kStep, max_error_rad))
    kept.push_back(pairs.order[i]);
  std::ranges::sort(kept);
  return kept;
}

TEST(SplitByHeight, CallsHighWhatIsHighInOneOfThePanoramas) {
  const std::vector<Vector3d> a = {
      AtElevation(0), AtElevation(20), AtElevation(-40), AtElevation(4)};
  const std::vector<Vector3d> b = {
      AtElevation(1), AtElevation(20), AtElevation(30), AtElevation(4)};
  const std::vector<FeatureMatch> matches = {{3, 3}, {0, 0}, {1, 1}, {2, 2}};
  const MatchesByHeight split = SplitByHeight(a, b, matches);
  EXPECT_EQ(split.low, (std::vector<FeatureMatch>{{3, 3}, {0, 0}}));
  EXPECT_EQ(split.high, (std::vector<FeatureMatch>{{1, 1}, {2, 2}}));
}

TEST(SplitByHeight, InverseDepthIsTheBaselineOverTheDepthFromTheFirstCamera) {
  for (const Vector3d& X : {Vector3d(3, -1, 2), Vector3d(0.5, 0.2, 7), Vector3d(-4, -8, -5)}) {
    const double found = InverseDepth(X.normalized(), (kStep * X).normalized(), kStep);
    EXPECT_NEAR(found, 1.0 / X.norm(), 1e-12);
  }
  EXPECT_EQ(InverseDepth(AtElevation(30), AtElevation(30), kStep), 0.0);
}

TEST(WithoutSky, TakesOutWhatIsHighAndFarBeyondWhatIsBelow) {
  const std::vector<Vector3d> points = {{3, 1, 2},
                                        {-3, 0.5, 4},
                                        {4, 1, -1},  // below, three to five steps away
                                        {4, -6, 1},  // a roof
                                        {200, -300, 100},
                                        {-5e3, -9e3, 1e3},  // clouds
                                        {300, 1, 400}};  // what is far on the horizon is no cloud
  EXPECT_EQ(KeptOf(points, 0.005), (std::vector<uint32_t>{0, 1, 2, 3, 6}));
}

TEST(WithoutSky, DoesNotTellWhereWhatIsBelowHasHardlyAnyParallaxOrIsNotThere) {
  const std::vector<Vector3d> far = {
      {300, 10, 20}, {-300, 50, 40}, {400, 10, -100}, {20, -4000, 1}};
  EXPECT_TRUE(KeptOf(far, 0.005).empty());
  EXPECT_TRUE(KeptOf({{3, -3, 2}, {-3, -4, 4}}, 0.005).empty());
  EXPECT_TRUE(KeptOf({}, 0.005).empty());
}

}  // namespace
}  // namespace orbweave
