// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_that_pairs_hold.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

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

/// A pair of an image of either half with matches that are where a turned street has them.
void AddPairOfTurnedStreet(BrokenStreet& street,
                           ImageSlot first,
                           ImageSlot second,
                           double angle_rad,
                           uint32_t num_matches) {
  ClusterProblem& problem = street.World().problem;
  const Rigid3 cam_from_world = TurnedPose(street, second, angle_rad);
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

TEST(PartsThatPairsHold, APairThatATornStreetFollowedIsOutvotedByThoseBesideTheTear) {
  BrokenStreet street({.pairs_between = 4});
  AddPairOfTurnedStreet(street, 3, 20, 0.5, 40);
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.5), {})), ElementsAre(12U, 12U));
}

TEST(PartsThatPairsHold, APairOfTwoLinesHoldsThem) {
  BrokenStreet street({.pairs_between = 4});
  for (ImageSlot image = BrokenStreet::kFirstOfSecond; image < BrokenStreet::kImages; ++image)
    street.World().problem.images[image].drive = 1;
  EXPECT_THAT(SizesOf(PartsThatPairsHold(Turned(street, 0.5), {})), ElementsAre(12U, 12U));
  AddPairOfTurnedStreet(street, 3, 20, 0.5, 40);
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
