// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_that_pairs_hold.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/mapping/checks/find_contradicted_pairs.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "tests/core/mapping/broken_street.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;

constexpr ImageSlot kPivot = BrokenStreet::kFirstOfSecond - 1;

/// A pose in the second half once that is turned about where the first one ends.
Rigid3 TurnedPose(const BrokenStreet& street, ImageSlot image, double angle_rad) {
  MappingState straight = street.Part(0, BrokenStreet::kImages, {});
  const Sim3 turn{
      1.0, RotationFromVector(angle_rad * Eigen::Vector3d(1.0, 1.0, 1.0).normalized()), {}};
  const Eigen::Vector3d pivot = straight.Centre(kPivot);
  const Sim3 about_pivot{1.0, turn.rotation, pivot - turn.rotation * pivot};
  return TransformCamera(about_pivot, straight.CamFromWorld(image));
}

/// The whole street with its second half turned.
MappingState Turned(const BrokenStreet& street, double angle_rad) {
  MappingState state = street.First();
  for (ImageSlot image = BrokenStreet::kFirstOfSecond; image < BrokenStreet::kImages; ++image)
    state.Register(image, TurnedPose(street, image, angle_rad));
  return state;
}

/// A pair of an image of either half with matches that are where a wrong model has them, of which
/// `cam_from_world` is the pose of the second.
void AddPairOfWrongModel(BrokenStreet& street,
                         ImageSlot first,
                         ImageSlot second,
                         const Rigid3& cam_from_world,
                         uint32_t num_matches) {
  ClusterProblem& problem = street.World().problem;
  const Rigid3& first_from_world = street.World().cams_from_world[first];
  const Rigid3 b_from_a = cam_from_world * first_from_world.Inverse();
  TwoViewGeometry pair{.pair = {ImageId(first), ImageId(second)},
                       .kind = TwoViewKind::kGeneral,
                       .b_from_a = b_from_a};
  ClusterImage& in_second = problem.images[second];
  for (FeatureIndex f = 0; f < num_matches; ++f) {
    const Eigen::Vector3d point = 12.0 * problem.images[first].bearings[f];
    pair.inliers.push_back({f, static_cast<FeatureIndex>(in_second.bearings.size())});
    in_second.bearings.push_back((b_from_a * point).normalized());
    in_second.sigma_rad.push_back(in_second.sigma_rad.front());
    in_second.colors.push_back(in_second.colors.front());
  }
  problem.pairs.push_back(pair);
  street.Rebuild();
}

/// A pose so far beside where it is, turned as it is.
Rigid3 PoseBeside(BrokenStreet& street, ImageSlot image, double aside) {
  const Sim3 beside{1.0, Eigen::Quaterniond::Identity(), {0.0, 0.0, aside}};
  return TransformCamera(beside, street.World().cams_from_world[image]);
}

/// The whole street with its second half beside where it is.
MappingState SetAside(BrokenStreet& street, double aside) {
  MappingState state = street.First();
  for (ImageSlot image = BrokenStreet::kFirstOfSecond; image < BrokenStreet::kImages; ++image)
    state.Register(image, PoseBeside(street, image, aside));
  return state;
}

/// As many matches again of each pair between the halves, of what is as high as its cameras, left
/// of the way behind them and right of it before them: they lie in the epipolar planes, and in
/// front of both, whether the second camera is ahead or to the left.
void AddMatchesAtTheHorizon(BrokenStreet& street) {
  RayStreet& world = street.World();
  const auto add = [&](uint32_t image, const Eigen::Vector3d& point) {
    ClusterImage& seeing = world.problem.images[image];
    seeing.bearings.push_back((world.cams_from_world[image] * point).normalized());
    seeing.sigma_rad.push_back(seeing.sigma_rad.front());
    seeing.colors.push_back(seeing.colors.front());
    return static_cast<FeatureIndex>(seeing.bearings.size() - 1);
  };
  for (TwoViewGeometry& pair : world.problem.pairs) {
    if (!BrokenStreet::IsBetween(pair)) continue;
    const auto [a, b] = std::pair(pair.pair.a.value, pair.pair.b.value);
    const Eigen::Vector3d start = world.cams_from_world[a].Centre();
    const Eigen::Vector3d way = world.cams_from_world[b].Centre() - start;
    const Eigen::Vector3d left = Eigen::Vector3d(-way.z(), 0.0, way.x()).normalized();
    const size_t count = pair.inliers.size();
    for (size_t i = 0; i < count; ++i) {
      const double beside = 2.0 + 30.0 * static_cast<double>(i) / static_cast<double>(count);
      const double along = 3.0 + static_cast<double>(i % 17);
      const Eigen::Vector3d point =
          i % 2 == 0 ? Eigen::Vector3d(start - along * way.normalized() + beside * left)
                     : Eigen::Vector3d(start + way + along * way.normalized() - beside * left);
      pair.inliers.push_back({add(a, point), add(b, point)});
    }
  }
  street.Rebuild();
}

/// The pair of images so many steps apart that leads from one half to the other.
const LinkedPair& PairBetween(const MappingState& state, uint32_t steps) {
  return *std::ranges::find_if(state.Graph().pairs, [&](const LinkedPair& pair) {
    return pair.a < BrokenStreet::kFirstOfSecond && pair.b >= BrokenStreet::kFirstOfSecond &&
           pair.b - pair.a == steps;
  });
}

std::vector<size_t> SizesOf(const std::vector<std::vector<ImageSlot>>& parts) {
  std::vector<size_t> sizes;
  for (const std::vector<ImageSlot>& part : parts) sizes.push_back(part.size());
  return sizes;
}

TEST(PartsThatPairsHold, ARightStreetIsOne) {
  const BrokenStreet street({.random_rotations = true, .pairs_between = 4});
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.0), {})), ElementsAre(24U));
}

TEST(PartsThatPairsHold, HalvesThatStandAskewAreTwo) {
  for (const bool random_rotations : {false, true}) {
    const BrokenStreet street({.random_rotations = random_rotations, .pairs_between = 4});
    const auto parts = PartsThatPairsHold(Turned(street, 0.5), {});
    ASSERT_THAT(SizesOf(parts), ElementsAre(12U, 12U));
    EXPECT_EQ(parts[0].front(), 0U);
    EXPECT_EQ(parts[0].back(), kPivot);
  }
}

TEST(PartsThatPairsHold, APairThatTheModelContradictsHoldsNothingThoughHalfOfItAgrees) {
  BrokenStreet street({.pairs_between = 1});
  AddMatchesAtTheHorizon(street);
  EXPECT_THAT(SizesOf(PartsThatPairsHold(SetAside(street, 0.0), {})), ElementsAre(24U));
  const MappingState torn = SetAside(street, 60.0);
  const LinkedPair& pair = PairBetween(torn, 1);
  EXPECT_NEAR(AgreementOfMatches(torn, pair, 8.0).Share(), 0.5, 0.1) << "is not askew";
  EXPECT_THAT(SizesOf(PartsThatPairsHold(torn, {})), ElementsAre(12U, 12U));
}

/// A pair of few matches may be some degrees off, and the model that points hold right.
TEST(PartsThatPairsHold, APairThatLeadsAboutTheSameWayTearsNothing) {
  BrokenStreet street({.pairs_between = 1});
  AddMatchesAtTheHorizon(street);
  const MappingState bent = SetAside(street, 2.0);
  EXPECT_FALSE(FindContradictedPairs(bent, {}).empty());
  EXPECT_THAT(SizesOf(PartsThatPairsHold(bent, {})), ElementsAre(24U));
}

TEST(PartsThatPairsHold, APairThatIsNotContradictedHoldsThemBesideOneThatIs) {
  BrokenStreet street({.pairs_between = 2});
  AddMatchesAtTheHorizon(street);
  for (TwoViewGeometry& pair : street.World().problem.pairs) {
    if (!BrokenStreet::IsBetween(pair) || pair.pair.b.value - pair.pair.a.value == 1) continue;
    const auto half = static_cast<int64_t>(pair.inliers.size() / 2);
    pair.inliers.erase(pair.inliers.begin(), pair.inliers.begin() + half);
  }
  street.Rebuild();
  EXPECT_THAT(SizesOf(PartsThatPairsHold(SetAside(street, 60.0), {})), ElementsAre(24U));
}

TEST(PartsThatPairsHold, WhatAgreesElsewhereHoldsNothingThatEveryPairAcrossTears) {
  BrokenStreet street({.pairs_between = 1});
  AddMatchesAtTheHorizon(street);
  AddPairOfWrongModel(street, 3, 20, PoseBeside(street, 20, 60.0), 40);
  EXPECT_THAT(SizesOf(PartsThatPairsHold(SetAside(street, 60.0), {})), ElementsAre(12U, 12U));
}

TEST(PartsThatPairsHold, APairThatATornStreetFollowedIsOutvotedByThoseBesideTheTear) {
  BrokenStreet street({.pairs_between = 4});
  AddPairOfWrongModel(street, 3, 20, TurnedPose(street, 20, 0.5), 40);
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.5), {})), ElementsAre(12U, 12U));
}

TEST(PartsThatPairsHold, APairOfTwoLinesHoldsThem) {
  BrokenStreet street({.pairs_between = 4});
  for (ImageSlot image = BrokenStreet::kFirstOfSecond; image < BrokenStreet::kImages; ++image)
    street.World().problem.images[image].drive = 1;
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.5), {})), ElementsAre(12U, 12U));
  AddPairOfWrongModel(street, 3, 20, TurnedPose(street, 20, 0.5), 40);
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.5), {})), ElementsAre(24U));
}

TEST(PartsThatPairsHold, FewMatchesAndPairsOfOneCentreTearNothing) {
  BrokenStreet few({.pairs_between = 1});
  for (TwoViewGeometry& pair : few.World().problem.pairs) {
    if (BrokenStreet::IsBetween(pair)) pair.inliers.resize(30);
  }
  few.Rebuild();
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(few, 0.5), {})), ElementsAre(24U));
  BrokenStreet still({.pairs_between = 4});
  for (TwoViewGeometry& pair : still.World().problem.pairs) {
    if (BrokenStreet::IsBetween(pair)) pair.kind = TwoViewKind::kPureRotation;
  }
  still.Rebuild();
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(still, 0.5), {})), ElementsAre(24U));
}

}  // namespace
}  // namespace orbweave
