// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pair_witness.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/core/mapping/true_state.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 5400.0;
constexpr ImageSlot kNew = 3;

/// Three registered images on a straight walk, and a fourth that is to be judged.
struct Walk {
  StreetFixture street{
      {.centres = StraightWalk(4, 3.0), .noise_px = 0.2, .random_rotations = true}};
  MappingState state = street.TriangulatedStateWith({0, 1, 2});
  std::vector<ViewMatches> views = MatchesWithRegistered(state, kNew);
  SceneCorrespondences points = FindSceneCorrespondences(state, kNew);
  Rigid3 truth = street.world.cams_from_world[kNew];

  [[nodiscard]] Rigid3 MovedTo(const Eigen::Vector3d& centre) const {
    return Rigid3::FromCentre(truth.rotation, centre);
  }
  [[nodiscard]] uint32_t CountMatches() const {
    uint32_t count = 0;
    for (const ViewMatches& view : views) count += static_cast<uint32_t>(view.in_view.size());
    return count;
  }
};

TEST(MatchesWithRegistered, AreThoseOfRegisteredImagesStrongestFirst) {
  const Walk walk;
  ASSERT_EQ(walk.views.size(), 3U);
  EXPECT_GE(walk.views[0].in_view.size(), walk.views[1].in_view.size());
  EXPECT_GE(walk.views[1].in_view.size(), walk.views[2].in_view.size());
  EXPECT_TRUE(MatchesWithRegistered(walk.street.StateWith({}), kNew).empty());
}

TEST(CountAgreeingMatches, CountsThemAtTheTruePoseAndNoneWithoutBaseline) {
  const Walk walk;
  EXPECT_GT(CountAgreeingMatches(walk.truth, walk.views, kMaxErrorRad), 0.95 * walk.CountMatches());
  for (const ViewMatches& view : walk.views) {
    EXPECT_EQ(CountAgreeingMatches(view.view_from_world, {&view, 1}, kMaxErrorRad), 0U);
  }
}

TEST(ContradictsStrongPair, SpeaksAgainstTheOtherSideOfTheNeighbourOnly) {
  const Walk walk;
  const Eigen::Vector3d nearest = walk.state.Centre(2);
  const Eigen::Vector3d step = walk.truth.Centre() - nearest;
  EXPECT_FALSE(ContradictsStrongPair(walk.truth, walk.views, kMaxErrorRad));
  const Rigid3 behind = walk.MovedTo(nearest - step);
  EXPECT_TRUE(ContradictsStrongPair(behind, walk.views, kMaxErrorRad));
  EXPECT_GT(CountAgreeingMatches(walk.truth, walk.views, kMaxErrorRad),
            CountAgreeingMatches(behind, walk.views, kMaxErrorRad));
  // Along the street a pair of directions says nothing of the length.
  EXPECT_FALSE(ContradictsStrongPair(walk.MovedTo(nearest + 2.0 * step), walk.views, kMaxErrorRad));
}

/// What has parallax then is what moved.
TEST(ContradictsStrongPair, IsFalseWhereTheCameraStood) {
  const Rigid3 pose = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {0.01, 0.0, 0.0});
  for (const auto& [movers, contradicts] : {std::pair(5, false), std::pair(30, true)}) {
    Random random(8);
    ViewMatches view;
    for (int i = 0; i < 200; ++i) {
      view.in_view.push_back(testing::RandomDirection(random));
      view.in_image.push_back(i < movers ? testing::RandomDirection(random) : view.in_view.back());
    }
    EXPECT_EQ(ContradictsStrongPair(pose, {&view, 1}, kMaxErrorRad), contradicts) << movers;
  }
}

TEST(ContradictsStrongPair, IsFalseWithoutPairs) {
  const Walk walk;
  EXPECT_FALSE(ContradictsStrongPair(walk.truth, {}, kMaxErrorRad));
}

TEST(IsLengthTold, ByPointsNearEnoughAndNotByFarOnes) {
  const Walk walk;
  EXPECT_TRUE(IsLengthTold(walk.truth, walk.points, walk.views, kMaxErrorRad));
  SceneCorrespondences far;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d at = walk.truth.Centre() + 1e5 * Eigen::Vector3d(1.0, 0.02 * i, 0.3);
    far.positions.push_back(at);
    far.bearings.push_back((walk.truth * at).normalized());
  }
  // Of a straight walk the matches tell no length either.
  EXPECT_FALSE(IsLengthTold(walk.truth, far, {walk.views.data(), 1}, kMaxErrorRad));
  EXPECT_TRUE(IsLengthTold(walk.truth, far, {}, kMaxErrorRad));
}

}  // namespace
}  // namespace orbweave
