// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/leave_out_carrier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mapping/reconstruct_cluster.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/ray_street.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxErrorPx = 4.0;
constexpr int kPanoramas = 12;
constexpr uint32_t kOfCarrier = 40;  // features, the last of each image
constexpr uint32_t kReach = 4;       // images between which the carrier alone matches

void AddFeature(const Vector3d& bearing, ClusterImage& image) {
  image.bearings.push_back(bearing.normalized());
  image.sigma_rad.push_back(image.sigma_rad.front());
  image.colors.push_back({});
}

std::vector<FeatureMatch> CarrierMatches(const ClusterImage& a, const ClusterImage& b) {
  std::vector<FeatureMatch> matches;
  for (uint32_t k = kOfCarrier; k > 0; --k) {
    matches.push_back({static_cast<FeatureIndex>(a.bearings.size() - k),
                       static_cast<FeatureIndex>(b.bearings.size() - k)});
  }
  return matches;
}

/// A straight street seen across the edge of a dashboard: each panorama has it, pairs of neighbours
/// match it beside the street, those further apart nothing else.
RayStreet BehindADashboard(double spacing_m, bool random_rotations = false) {
  RayStreet world = MakeStreet({.centres = StraightWalk(kPanoramas, spacing_m),
                                .points_per_metre = 40,
                                .window = 3,
                                .random_rotations = random_rotations});
  for (ClusterImage& image : world.problem.images) {
    const double at_m = spacing_m * image.id.value;
    image.prior.position_in_enu = Vector3d(at_m, 0.0, 0.0);
    image.prior.horizontal_sigma_m = 1.0;
    for (uint32_t k = 0; k < kOfCarrier; ++k) {
      const double azimuth = 0.03 * k;
      AddFeature({std::cos(azimuth), 0.2, std::sin(azimuth)}, image);
    }
  }
  std::vector<TwoViewGeometry>& pairs = world.problem.pairs;
  for (TwoViewGeometry& pair : pairs) {
    const std::vector<FeatureMatch> more = CarrierMatches(world.problem.images[pair.pair.a.value],
                                                          world.problem.images[pair.pair.b.value]);
    pair.inliers.insert(pair.inliers.end(), more.begin(), more.end());
  }
  for (uint32_t a = 0; a + kReach < kPanoramas; ++a) {
    const ImagePair pair{ImageId(a), ImageId(a + kReach)};
    pairs.push_back(
        {.pair = pair,
         .kind = TwoViewKind::kGeneral,
         .b_from_a = {Eigen::Quaterniond::Identity(), Vector3d::UnitZ()},
         .inliers = CarrierMatches(world.problem.images[a], world.problem.images[a + kReach]),
         .num_putative = 2 * kOfCarrier,
         .log10_false_alarms = -40.0});
  }
  std::ranges::sort(pairs, {}, &TwoViewGeometry::pair);
  return world;
}

bool IsOfCarrier(const ClusterProblem& problem, ImageId image, FeatureIndex feature) {
  return feature + kOfCarrier >= problem.images[image.value].bearings.size();
}

TEST(LeaveOutCarrier, LeavesTheScene) {
  const RayStreet world = BehindADashboard(10.0);
  const auto scene = LeaveOutCarrier(world.problem, kMaxErrorPx);
  ASSERT_TRUE(scene.has_value());
  size_t left = 0;
  size_t of_scene = 0;
  for (const TwoViewGeometry& pair : scene->problem.pairs) {
    EXPECT_LT(pair.pair.b.value - pair.pair.a.value, kReach) << "of which nothing is left";
    for (const FeatureMatch& match : pair.inliers)
      EXPECT_FALSE(IsOfCarrier(world.problem, pair.pair.a, match.a));
    left += pair.inliers.size();
  }
  for (const TwoViewGeometry& pair : world.problem.pairs) {
    of_scene += static_cast<size_t>(std::ranges::count_if(pair.inliers, [&](const auto& match) {
      return !IsOfCarrier(world.problem, pair.pair.a, match.a);
    }));
  }
  EXPECT_EQ(left, of_scene);
  EXPECT_EQ(scene->pairs_of_carrier.size(), static_cast<size_t>(kPanoramas - kReach));
  EXPECT_FALSE(LeaveOutCarrier(scene->problem, kMaxErrorPx).has_value())
      << "there is no more of it";
}

TEST(LeaveOutCarrier, IsSilentWhereNothingSaysThatTheCameraMoved) {
  RayStreet world = BehindADashboard(10.0);
  for (ClusterImage& image : world.problem.images) image.prior.horizontal_sigma_m = 20.0;
  EXPECT_FALSE(LeaveOutCarrier(world.problem, kMaxErrorPx).has_value());
  for (ClusterImage& image : world.problem.images) image.prior.position_in_enu.reset();
  EXPECT_FALSE(LeaveOutCarrier(world.problem, kMaxErrorPx).has_value());
  EXPECT_FALSE(LeaveOutCarrier(BehindADashboard(1.0).problem, kMaxErrorPx).has_value());
}

TEST(LeaveOutCarrier, ALonePairIsNoCarrier) {
  RayStreet world = BehindADashboard(10.0);
  std::erase_if(world.problem.pairs,
                [](const TwoViewGeometry& pair) { return pair.pair.a.value > 1; });
  std::erase_if(world.problem.pairs,
                [](const TwoViewGeometry& pair) { return pair.pair.b.value > 1; });
  EXPECT_FALSE(LeaveOutCarrier(world.problem, kMaxErrorPx).has_value());
}

TEST(LeaveOutCarrier, PairsThatTurnKeepWhatTheyHave) {
  const RayStreet world = BehindADashboard(10.0, true);
  const auto scene = LeaveOutCarrier(world.problem, kMaxErrorPx);
  ASSERT_TRUE(scene.has_value());
  for (const TwoViewGeometry& pair : world.problem.pairs) {
    const auto kept = std::ranges::find(scene->problem.pairs, pair.pair, &TwoViewGeometry::pair);
    const bool is_carrier_alone = pair.inliers.size() == kOfCarrier;
    ASSERT_EQ(kept == scene->problem.pairs.end(), is_carrier_alone);
    if (is_carrier_alone) continue;
    EXPECT_EQ(kept->inliers.size(), pair.inliers.size());
  }
}

TEST(LeaveOutCarrier, TheStreetComesOutAsItIs) {
  const RayStreet world = BehindADashboard(10.0);
  const auto result = ReconstructCluster(world.problem, {}, {.seed = 5});
  ASSERT_TRUE(result.ok()) << result.status();
  ASSERT_EQ(result->submodels.size(), 1U);
  EXPECT_EQ(result->pairs_of_carrier.size(), static_cast<size_t>(kPanoramas - kReach));
  EXPECT_EQ(result->submodels[0].images.size(), static_cast<size_t>(kPanoramas));
  EXPECT_LT(ErrorOf(result->submodels[0], world.cams_from_world).position_rmse, 0.05);
  for (const Track& track : result->submodels[0].tracks) {
    for (const Observation& seen : track.observations)
      EXPECT_FALSE(IsOfCarrier(world.problem, seen.ref.image, seen.ref.feature));
  }
}

}  // namespace
}  // namespace orbweave
