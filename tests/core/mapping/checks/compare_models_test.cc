// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/compare_models.h"

#include <gtest/gtest.h>

#include "core/mapping/checks/check_against_pairs.h"
#include "core/mapping/checks/position_misfit.h"
#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

/// With images [first, end) so many metres further along the street, and the points that remain
/// there.
MappingState Slid(const GnssWalk& walk, ImageSlot first, ImageSlot end, double metres) {
  const StreetFixture& street = walk.Fixture();
  MappingState state(street.world.problem, street.graph);
  for (ImageSlot image = 0; image < GnssWalk::kImages; ++image)
    state.Register(image, walk.Further(image, image >= first && image < end ? metres : 0.0));
  for (const ImageSlot image : state.Registered()) TriangulateImage(state, image, TrackLimits{});
  return state;
}

MappingState TornAt(const GnssWalk& walk, ImageSlot first, double metres) {
  return Slid(walk, first, GnssWalk::kImages, metres);
}

/// The first images alone, without points.
MappingState Part(const GnssWalk& walk, ImageSlot end) {
  MappingState state(walk.Fixture().world.problem, walk.Fixture().graph);
  for (ImageSlot image = 0; image < end; ++image) state.Register(image, walk.InModel(image));
  return state;
}

TEST(IsBetterModel, PrefersTheOneForWhichMoreSpeaks) {
  const GnssWalk walk;
  const MappingState right = TornAt(walk, GnssWalk::kImages, 0.0);
  const MappingState torn = TornAt(walk, 7, 5.0);
  EXPECT_GT(CountHeldPlaces(right), CountHeldPlaces(torn));
  EXPECT_TRUE(IsBetterModel(right, torn, {}));
  EXPECT_FALSE(IsBetterModel(torn, right, {}));
  EXPECT_FALSE(IsBetterModel(right, right, {}));
}

TEST(IsBetterModel, PrefersALargerOneOfWhichGnssBearsOutMuchMore) {
  const GnssWalk walk;
  const MappingState all = walk.StateWithout(GnssWalk::kImages);
  const MappingState few = Part(walk, 6);
  EXPECT_TRUE(IsBetterModel(all, few, {}));
  EXPECT_FALSE(IsBetterModel(few, all, {}));
}

TEST(IsLikedByGnss, WhereTheOtherIsTorn) {
  const GnssWalk walk;
  const MappingState right = TornAt(walk, GnssWalk::kImages, 0.0);
  const MappingState torn = TornAt(walk, 7, 9.0);
  EXPECT_TRUE(IsLikedByGnss(right, torn, {}));
  EXPECT_FALSE(IsLikedByGnss(torn, right, {}));
  EXPECT_FALSE(IsLikedByGnss(right, right, {}));
}

TEST(IsLikedByGnss, NotForWrongPositions) {
  GnssWalk walk;
  for (const uint32_t image : {6U, 7U})
    *walk.Prior(image).position_in_enu += Eigen::Vector3d(5.0, 0.0, 0.0);
  const MappingState right = TornAt(walk, GnssWalk::kImages, 0.0);
  const MappingState fooled = Slid(walk, 6, 8, 5.0);
  EXPECT_FALSE(IsLikedByGnss(fooled, right, {}));
  EXPECT_TRUE(IsBetterModel(right, fooled, {}));
}

/// Positions whose errors all have the same side of a street elsewhere bend with a model that is
/// torn there.
TEST(IsLikedByGnss, NotWhereAModelIsTorn) {
  GnssWalk walk;
  const Eigen::Vector3d aside(0.0, 1.5, 0.0);
  for (uint32_t image = 7; image < GnssWalk::kImages; ++image)
    *walk.Prior(image).position_in_enu += aside;
  const MappingState right = TornAt(walk, GnssWalk::kImages, 0.0);
  MappingState torn = right;
  for (ImageSlot image = 7; image < GnssWalk::kImages; ++image) {
    const Rigid3& truth = walk.Fixture().world.cams_from_world[image];
    torn.SetPose(
        image,
        TransformCamera(
            walk.model_from_world,
            Rigid3::FromCentre(truth.rotation, truth.Centre() + 1.5 * Eigen::Vector3d::UnitZ())));
  }
  EXPECT_LT(PositionMisfit(torn, 8.0).Beside(PositionMisfit(right, 8.0)),
            PositionMisfit(right, 8.0).Beside(PositionMisfit(torn, 8.0)));
  EXPECT_FALSE(IsLikedByGnss(torn, right, {}));
  EXPECT_TRUE(IsBetterModel(right, torn, {}));
  EXPECT_FALSE(IsBetterModel(torn, right, {}));
}

TEST(IsLikedByGnss, WhereMoreImagesAreBorneOutAsWell) {
  const GnssWalk walk;
  const MappingState all = Part(walk, GnssWalk::kImages);
  const MappingState most = Part(walk, 10);
  EXPECT_TRUE(IsLikedByGnss(all, most, {}));
  EXPECT_FALSE(IsLikedByGnss(most, all, {}));
  EXPECT_FALSE(IsLikedByGnss(TornAt(walk, 7, 40.0), most, {}));
}

TEST(IsLikedByGnss, NotWithoutPositions) {
  GnssWalk walk;
  for (uint32_t image = 0; image < GnssWalk::kImages; ++image)
    walk.Prior(image).position_in_enu.reset();
  EXPECT_FALSE(IsLikedByGnss(TornAt(walk, GnssWalk::kImages, 0.0), TornAt(walk, 7, 5.0), {}));
}

TEST(CountHeldPlaces, CountsWhereFourSee) {
  const GnssWalk walk;
  EXPECT_GT(CountHeldPlaces(walk.StateWithout(GnssWalk::kImages)), 14U * 10U);
  const MappingState without_points(walk.Fixture().world.problem, walk.Fixture().graph);
  EXPECT_EQ(CountHeldPlaces(without_points), 0U);
}

TEST(IsContested, OnlyWherePairsDisagree) {
  const GnssWalk walk;
  EXPECT_FALSE(IsContested(walk.StateWithout(GnssWalk::kImages), {}));
  MappingState moved = walk.StateWithout(GnssWalk::kImages);
  const Rigid3 pose = moved.CamFromWorld(5);
  const Eigen::Vector3d aside = pose.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, 0.8);
  moved.SetPose(5, Rigid3::FromCentre(pose.rotation, pose.Centre() + aside));
  EXPECT_TRUE(IsContested(moved, {}));
}

TEST(IsContested, WhereRaysContradictWhatNoPairDoes) {
  const GnssWalk walk;
  MappingState moved = walk.StateWithout(GnssWalk::kImages);
  moved.SetPose(5, walk.Further(5, 6.0));
  EXPECT_EQ(CheckAgainstPairs(moved, {}).agreeing_share, 1.0);
  EXPECT_TRUE(IsContested(moved, {}));
}

}  // namespace
}  // namespace orbweave
