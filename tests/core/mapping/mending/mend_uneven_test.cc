// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/mend_uneven.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/checks/uneven_images.h"
#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// In order, and no position is known.
struct Walk : GnssWalk {
  Walk() {
    for (uint32_t i = 0; i < kImages; ++i) {
      Image(i).rank_in_drive = i;
      Prior(i).position_in_enu.reset();
    }
  }
};

/// With the images [first, end) so far along the street, and the points that they see there.
MappingState Moved(const GnssWalk& walk, ImageSlot first, ImageSlot end, double metres) {
  MappingState state(walk.Fixture().world.problem, walk.Fixture().graph);
  for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
    state.Register(image, walk.Further(image, image >= first && image < end ? metres : 0.0));
  for (const ImageSlot image : state.Registered()) TriangulateImage(state, image, TrackLimits{});
  return state;
}

/// By how much of a step an image is off, all others in place.
double ErrorOf(const GnssWalk& walk, const MappingState& state, ImageSlot image) {
  const double step = (walk.InModel(1).Centre() - walk.InModel(0).Centre()).norm();
  return (state.Centre(image) - walk.InModel(image).Centre()).norm() / step;
}

TEST(FindUnevenRuns, FindsNothingWhereAllStandRight) {
  const Walk walk;
  EXPECT_THAT(FindUnevenRuns(Moved(walk, 0, 0, 0.0)), IsEmpty());
}

TEST(FindUnevenRuns, NamesTheRunInItsOrder) {
  const Walk walk;
  const std::vector<UnevenRun> runs = FindUnevenRuns(Moved(walk, 6, 7, 4.0));
  ASSERT_THAT(runs, SizeIs(1));
  EXPECT_THAT(runs[0].images, ElementsAre(5, 6, 7));
  EXPECT_EQ(runs[0].uneven.stop, 1U);
  EXPECT_EQ(runs[0].uneven.last, 2U);
}

TEST(FindUnevenRuns, BelievesPositions) {
  Walk walk;
  walk.SetExactPositions();
  EXPECT_THAT(FindUnevenRuns(Moved(walk, 6, 7, 4.0)), SizeIs(1));
  walk.Prior(6).position_in_enu->x() += 4.0;
  EXPECT_THAT(FindUnevenRuns(Moved(walk, 6, 7, 4.0)), IsEmpty());
}

TEST(FindUnevenRuns, AsksNobodyWhoseOrderIsNotKnown) {
  Walk walk;
  for (uint32_t i = 0; i < GnssWalk::kImages; ++i) walk.Image(i).rank_in_drive = 0;
  EXPECT_THAT(FindUnevenRuns(Moved(walk, 6, 7, 4.0)), IsEmpty());
}

TEST(MendUneven, PutsWhoStandsAWindowOffBack) {
  const Walk walk;
  for (const ImageSlot end : {7U, 8U}) {
    MappingState state = Moved(walk, 6, end, 4.0);
    const auto has_moved = MendUneven(state, {}, {});
    ASSERT_TRUE(has_moved.ok()) << has_moved.status();
    EXPECT_TRUE(*has_moved);
    EXPECT_THAT(FindUnevenRuns(state), IsEmpty());
    for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
      EXPECT_LT(ErrorOf(walk, state, image), 0.1) << image;
  }
}

TEST(FindVanishedWays, NamesAStepThatIsGoneOrLeadsBackUnlessPositionsDo) {
  for (const double steps : {0.9, 2.0}) {
    Walk walk;
    const double back_m = -steps * GnssWalk::kStep_m;
    const MappingState state = Moved(walk, 6, GnssWalk::kImages, back_m);
    const std::vector<VanishedWay> ways = FindVanishedWays(state);
    ASSERT_THAT(ways, SizeIs(1));
    EXPECT_EQ(ways[0].image, 5U);
    EXPECT_EQ(ways[0].next, 6U);
    EXPECT_NEAR(ways[0].share, 1.0 - steps, 0.05);
    walk.SetExactPositions();
    EXPECT_THAT(FindVanishedWays(state), SizeIs(1));
    for (ImageSlot image = 6; image < GnssWalk::kImages; ++image)
      walk.Prior(image).position_in_enu->x() += back_m;
    EXPECT_THAT(FindVanishedWays(state), IsEmpty());
  }
}

TEST(MendUneven, PutsWhatLiesBehindAStepThatIsGoneOrLeadsBackWhereItWas) {
  const Walk walk;
  for (const double steps : {0.9, 2.0}) {
    MappingState state = Moved(walk, 6, GnssWalk::kImages, -steps * GnssWalk::kStep_m);
    const auto has_moved = MendUneven(state, {}, {});
    ASSERT_TRUE(has_moved.ok()) << has_moved.status();
    EXPECT_TRUE(*has_moved);
    for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
      EXPECT_LT(ErrorOf(walk, state, image), 0.1) << image;
  }
}

TEST(MendUneven, LeavesWhatIsEvenAsItIs) {
  const Walk walk;
  MappingState state = Moved(walk, 0, 0, 0.0);
  const auto has_moved = MendUneven(state, {}, {});
  ASSERT_TRUE(has_moved.ok()) << has_moved.status();
  EXPECT_FALSE(*has_moved);
  for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
    EXPECT_EQ(state.Centre(image), walk.InModel(image).Centre());
}

TEST(MendUneven, LeavesAPanoramaThatWasTakenLateWhereItWas) {
  for (const double late_m : {3.0, 4.0, -3.5}) {
    std::vector<Eigen::Vector3d> centres = StraightWalk(GnssWalk::kImages, GnssWalk::kStep_m);
    centres[6].x() += late_m;
    StreetFixture street(
        {.centres = centres, .points_per_metre = 4, .reach_m = 30.0, .window = 4, .seed = 3});
    for (uint32_t i = 0; i < GnssWalk::kImages; ++i)
      street.world.problem.images[i].rank_in_drive = i;
    MappingState state = street.TriangulatedStateWith(FirstImages(GnssWalk::kImages));
    ASSERT_THAT(FindUnevenRuns(state), SizeIs(1));
    ASSERT_TRUE(MendUneven(state, {}, {}).ok());
    for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
      EXPECT_LT((state.Centre(image) - centres[image]).norm(), 0.1) << image << " " << late_m;
  }
}

TEST(MendUneven, StopsWhenAsked) {
  const Walk walk;
  MappingState state = Moved(walk, 6, 7, 4.0);
  StageContext context;
  std::stop_source stop;
  stop.request_stop();
  context.stop = stop.get_token();
  EXPECT_EQ(MendUneven(state, {}, context).status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
