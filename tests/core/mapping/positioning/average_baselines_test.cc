// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/average_baselines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/core/mapping/broken_street.h"

namespace orbweave {
namespace {

constexpr double kMinAngleRad = 0.026;

/// A straight walk whose steps differ by up to a factor of three.
std::vector<Eigen::Vector3d> UnevenWalk(int count) {
  std::vector<Eigen::Vector3d> centres;
  double x = 0.0;
  for (int i = 0; i < count; ++i) {
    centres.emplace_back(x, 0.0, 0.0);
    x += 2.0 + std::sin(1.3 * i);
  }
  return centres;
}

std::vector<uint32_t> AllPairs(const StreetFixture& street) {
  std::vector<uint32_t> pairs(street.graph.pairs.size());
  std::iota(pairs.begin(), pairs.end(), 0U);
  return pairs;
}

std::vector<double> Averaged(const StreetFixture& street, std::span<const uint32_t> pairs) {
  const auto found =
      AverageBaselines(street.world.problem, street.graph, pairs, {}, kMinAngleRad, {});
  EXPECT_TRUE(found.ok()) << found.status();
  return found.ok() ? found->lengths : std::vector<double>(pairs.size(), 0.0);
}

/// Largest deviation of length / true length from that of the first pair, as a share of it.
double WorstRatio(const StreetFixture& street,
                  const std::vector<uint32_t>& pairs,
                  const std::vector<double>& lengths) {
  double first = 0.0;
  double worst = 0.0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const LinkedPair& pair = street.graph.pairs[pairs[i]];
    const double truth = (street.world.cams_from_world[pair.a].Centre() -
                          street.world.cams_from_world[pair.b].Centre())
                             .norm();
    if (i == 0) first = lengths[i] / truth;
    worst = std::max(worst, std::abs(lengths[i] / truth / first - 1.0));
  }
  return worst;
}

TEST(AverageBaselines, RecoversTheStepsOfAStraightStreet) {
  StreetFixture street({.centres = UnevenWalk(15), .noise_px = 0.0});
  for (TwoViewGeometry& pair : street.world.problem.pairs) {
    const Rigid3 b_from_a = street.world.cams_from_world[pair.pair.b.value] *
                            street.world.cams_from_world[pair.pair.a.value].Inverse();
    pair.b_from_a.rotation = b_from_a.rotation;
  }
  const std::vector<uint32_t> pairs = AllPairs(street);
  EXPECT_LT(WorstRatio(street, pairs, Averaged(street, pairs)), 1e-6);
}

TEST(AverageBaselines, IsGoodToAFewPerCentWithNoiseAndWrongMatches) {
  const StreetFixture street(
      {.centres = UnevenWalk(15), .noise_px = 0.5, .outlier_share = 0.3, .random_rotations = true});
  const std::vector<uint32_t> pairs = AllPairs(street);
  EXPECT_LT(WorstRatio(street, pairs, Averaged(street, pairs)), 0.05);
}

TEST(AverageBaselines, IsZeroForPairsThatNoSharedRaysJoin) {
  std::vector<Eigen::Vector3d> centres = UnevenWalk(8);
  for (const Eigen::Vector3d& centre : UnevenWalk(4)) {
    centres.push_back(centre + Eigen::Vector3d(500.0, 0.0, 0.0));
  }
  const StreetFixture street({.centres = centres});
  const std::vector<uint32_t> pairs = AllPairs(street);
  const std::vector<double> lengths = Averaged(street, pairs);
  for (size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(lengths[i] > 0.0, street.graph.pairs[pairs[i]].a < 8) << i;
  }
}

TEST(AverageBaselines, IsInMetresWhereGnssHasTheSteps) {
  BrokenStreet street({});
  street.DetachPairsBetween();
  const ClusterProblem& problem = street.World().problem;
  std::vector<uint32_t> pairs(street.Graph().pairs.size());
  std::iota(pairs.begin(), pairs.end(), 0U);
  const std::vector<GnssStep> steps = GnssSteps(problem, street.Graph(), pairs);
  const auto with = AverageBaselines(problem, street.Graph(), pairs, steps, kMinAngleRad, {});
  const auto without = AverageBaselines(problem, street.Graph(), pairs, {}, kMinAngleRad, {});
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_TRUE(with->in_metres);
  EXPECT_FALSE(without->in_metres);
  uint32_t unknown = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const LinkedPair& pair = street.Graph().pairs[pairs[i]];
    const double truth = (street.PlaceInEnu(pair.a) - street.PlaceInEnu(pair.b)).norm();
    const bool is_between = BrokenStreet::IsBetween(problem.pairs[pair.index]);
    EXPECT_NEAR(with->lengths[i] / truth, 1.0, is_between ? 0.5 : 0.15) << pair.a << " " << pair.b;
    unknown += without->lengths[i] == 0.0 ? 1U : 0U;
  }
  EXPECT_GT(unknown, pairs.size() / 3) << "one side and what is between";
}

TEST(AverageBaselines, HasNothingToSayWithoutPairs) {
  const StreetFixture street({.centres = UnevenWalk(4)});
  EXPECT_TRUE(Averaged(street, {}).empty());
}

}  // namespace
}  // namespace orbweave
