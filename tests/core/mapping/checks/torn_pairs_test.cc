// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/torn_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mapping/checks/find_contradicted_pairs.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr ImageSlot kFirstBehind = 8;

/// Pairs from before the tear to behind it.
MATCHER(LeadsAcross, "") { return arg.a.value < kFirstBehind && arg.b.value >= kFirstBehind; }

/// Everything behind the tear to one side by so many metres.
MappingState TornAside(const TornStreet& street, double by_m) {
  MappingState state = street.Right();
  for (ImageSlot image = kFirstBehind; image < TornStreet::kImages; ++image)
    TornStreet::Move(image, {0.0, 0.0, by_m}, state);
  return state;
}

TEST(FindTornPairs, FindsNoneInARightModel) {
  EXPECT_THAT(FindTornPairs(TornStreet().Right(), {}), IsEmpty());
}

TEST(FindTornPairs, FindsThoseAcrossATear) {
  const std::vector<ImagePair> torn = FindTornPairs(TornAside(TornStreet(), 4.0), {});
  EXPECT_THAT(torn, Contains(ImagePair{ImageId(kFirstBehind - 1), ImageId(kFirstBehind)}));
  EXPECT_THAT(torn, Each(LeadsAcross()));
}

/// What stands too far along the street is for lengths to tell.
TEST(FindTornPairs, FindsNoneWhereTheModelIsStretched) {
  TornStreet street;
  MappingState state = street.Right();
  for (ImageSlot image = kFirstBehind; image < TornStreet::kImages; ++image)
    TornStreet::Move(image, {4.0, 0.0, 0.0}, state);
  EXPECT_THAT(FindTornPairs(state, {}), Not(Contains(LeadsAcross())));
}

TEST(FindTornPairs, WhateverDrivesTheImagesAreOf) {
  TornStreet street;
  for (ImageSlot image = kFirstBehind; image < TornStreet::kImages; ++image)
    street.Fixture().world.problem.images[image].drive = 1;
  EXPECT_THAT(FindTornPairs(street.Right(), {}), IsEmpty());
  EXPECT_THAT(FindTornPairs(TornAside(street, 4.0), {}),
              Contains(ImagePair{ImageId(kFirstBehind - 1), ImageId(kFirstBehind)}));
}

TEST(FindTornPairs, PlacesThatLookAlikeAreNotBesideEachOther) {
  TornStreet street;
  RayStreet& world = street.Fixture().world;
  TwoViewGeometry alike{.pair = {ImageId(2), ImageId(13)}, .kind = TwoViewKind::kGeneral};
  alike.b_from_a.translation = Eigen::Vector3d::UnitY();
  // Matches that lie in the planes of its own pose and nowhere in the model's.
  ClusterImage& a = world.problem.images[2];
  ClusterImage& b = world.problem.images[13];
  for (FeatureIndex f = 0; f < 200; ++f) {
    b.bearings[f] = (8.0 * a.bearings[f] + alike.b_from_a.translation).normalized();
    alike.inliers.push_back({f, f});
  }
  world.problem.pairs.push_back(alike);
  street.Fixture().graph = BuildCorrespondenceGraph(world.problem).value();
  const MappingState state = street.Right();
  EXPECT_THAT(JudgePairs(state, {}).askew, Contains(alike.pair));
  EXPECT_THAT(FindTornPairs(state, {}), Not(Contains(alike.pair)));
}

}  // namespace
}  // namespace orbweave
