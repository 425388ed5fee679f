// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/unite_tracks.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr double kMaxError = 10.0;

// Cameras a metre apart that look at a point with exact bearings.
class UniteTracksTest : public ::testing::Test {
 protected:
  UniteTracksTest() {
    Random random(1);
    for (uint32_t i = 0; i < 8; ++i) {
      images_[ImageId(i)].cam_from_world =
          Rigid3::FromCentre(orbweave::testing::RandomRotation(random), {1.0 * i, 0.0, 0.0});
    }
  }

  Track See(const Eigen::Vector3d& point, const std::vector<FeatureRef>& refs) const {
    Track track{.point_in_world = point};
    for (const FeatureRef& ref : refs) {
      const auto image = images_.find(ref.image);
      const Eigen::Vector3d bearing =
          image == images_.end()
              ? Eigen::Vector3d::UnitZ()
              : orbweave::testing::BearingOf(image->second.cam_from_world, point);
      track.observations.push_back({.ref = ref, .bearing = bearing});
    }
    return track;
  }

  std::map<ImageId, RegisteredImage> images_{};
  const Eigen::Vector3d point_{3.0, 5.0, 1.0};
  const Eigen::Vector3d other_point_{3.0, -5.0, 2.0};
};

std::vector<FeatureRef> RefsOf(const Track& track) {
  std::vector<FeatureRef> refs;
  for (const Observation& observation : track.observations) refs.push_back(observation.ref);
  return refs;
}

TEST_F(UniteTracksTest, UnitesTracksThatShareAFeature) {
  const std::vector<Track> tracks = {See(point_, {{ImageId(2), 4}, {ImageId(3), 4}}),
                                     See(other_point_, {{ImageId(0), 1}, {ImageId(1), 1}}),
                                     See(point_, {{ImageId(3), 4}, {ImageId(5), 9}}),
                                     See(point_, {{ImageId(1), 7}, {ImageId(5), 9}})};
  const UnitedTracks united = UniteTracks(tracks, images_, kMaxError);
  ASSERT_EQ(united.tracks.size(), 2U);
  EXPECT_EQ(united.num_united, 1U);
  EXPECT_EQ(united.num_conflicting, 0U);
  EXPECT_EQ(united.tracks[0].Name(), (FeatureRef{ImageId(0), 1}));
  EXPECT_EQ(RefsOf(united.tracks[1]),
            (std::vector<FeatureRef>{
                {ImageId(1), 7}, {ImageId(2), 4}, {ImageId(3), 4}, {ImageId(5), 9}}));
  EXPECT_LT((united.tracks[1].point_in_world - point_).norm(), 1e-12);
}

TEST_F(UniteTracksTest, WeighsPointsByObservations) {
  std::vector<Track> tracks = {See(point_, {{ImageId(0), 1}, {ImageId(1), 1}, {ImageId(2), 1}}),
                               See(point_, {{ImageId(2), 1}, {ImageId(3), 1}})};
  tracks[1].point_in_world += Eigen::Vector3d(0.0, 0.005, 0.0);
  tracks[0].color = {1, 2, 3};
  const UnitedTracks united = UniteTracks(tracks, images_, kMaxError);
  ASSERT_EQ(united.tracks.size(), 1U);
  EXPECT_NEAR(united.tracks[0].point_in_world.y(), 5.002, 1e-12);
  EXPECT_EQ(united.tracks[0].color, (Rgb{1, 2, 3}));
}

TEST_F(UniteTracksTest, RefusesTwoFeaturesOfOneImage) {
  const std::vector<Track> tracks = {
      See(point_, {{ImageId(0), 1}, {ImageId(1), 1}, {ImageId(2), 1}}),
      See(point_, {{ImageId(0), 2}, {ImageId(2), 1}, {ImageId(3), 1}, {ImageId(4), 1}})};
  const UnitedTracks united = UniteTracks(tracks, images_, kMaxError);
  EXPECT_EQ(united.num_conflicting, 1U);
  ASSERT_EQ(united.tracks.size(), 2U);
  EXPECT_EQ(RefsOf(united.tracks[0]), (std::vector<FeatureRef>{{ImageId(0), 1}, {ImageId(1), 1}}))
      << "the shared feature goes to the longer track";
  EXPECT_EQ(united.tracks[1].observations.size(), 4U);
}

TEST_F(UniteTracksTest, RefusesPointsThatAreNotOne) {
  std::vector<Track> tracks;
  for (FeatureIndex f = 10; f < 20; ++f) {  // the rest of the world agrees
    tracks.push_back(See(point_, {{ImageId(0), f}, {ImageId(1), f}}));
    tracks.push_back(See(point_, {{ImageId(1), f}, {ImageId(2), f}}));
  }
  tracks.push_back(See(point_, {{ImageId(0), 1}, {ImageId(1), 1}}));
  tracks.push_back(See(other_point_, {{ImageId(1), 1}, {ImageId(2), 1}, {ImageId(3), 1}}));
  const UnitedTracks united = UniteTracks(tracks, images_, kMaxError);
  EXPECT_EQ(united.num_united, 10U);
  EXPECT_EQ(united.num_conflicting, 1U);
  EXPECT_EQ(united.tracks.size(), 11U) << "the shorter is left with one observation and goes";
}

TEST_F(UniteTracksTest, DropsObservationsOfImagesThatAreNotThere) {
  const std::vector<Track> tracks = {
      See(point_, {{ImageId(0), 1}, {ImageId(1), 1}, {ImageId(90), 1}}),
      See(point_, {{ImageId(2), 5}, {ImageId(91), 1}})};
  const UnitedTracks united = UniteTracks(tracks, images_, kMaxError);
  ASSERT_EQ(united.tracks.size(), 1U);
  EXPECT_EQ(united.tracks[0].observations.size(), 2U);
}

TEST_F(UniteTracksTest, AcceptsNothing) {
  EXPECT_TRUE(UniteTracks({}, {}, kMaxError).tracks.empty());
}

}  // namespace
}  // namespace orbweave
