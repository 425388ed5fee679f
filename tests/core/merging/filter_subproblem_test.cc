// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/filter_subproblem.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kWidth_px = 3600;  // ten pixels to the degree

// Four panoramas a metre apart on the x axis that see (0, 0, 5) and, far off, (0, 0, 500).
Subproblem MakeSubproblem() {
  Subproblem subproblem;
  for (uint32_t i = 0; i < 4; ++i) {
    subproblem.images.push_back({.id = ImageId(i), .camera = {kWidth_px, kWidth_px / 2}});
    subproblem.scene.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1.0 * i, 0.0, 0.0});
  }
  for (uint32_t t = 0; t < 2; ++t) {
    Track track{.point_in_world = {0.0, 0.0, t == 0 ? 5.0 : 500.0}};
    for (uint32_t i = 0; i < 4; ++i) {
      const Rigid3& cam_from_world = subproblem.scene.images.at(ImageId(i)).cam_from_world;
      track.observations.push_back(
          {.ref = {ImageId(i), t},
           .bearing = (cam_from_world * track.point_in_world).normalized()});
    }
    subproblem.scene.tracks.push_back(track);
  }
  return subproblem;
}

constexpr double kMinAngle_rad = 0.017;

TEST(FilterSubproblem, RemovesWhatIsTooFarFromItsBearing) {
  Subproblem subproblem = MakeSubproblem();
  Eigen::Vector3d& bearing = subproblem.scene.tracks[0].observations[2].bearing;
  bearing = RotationFromVector({0.0, 0.0087, 0.0}) * bearing;  // 5 px
  const auto lenient = FilterSubproblem(subproblem, 5.5, 0.0);
  EXPECT_EQ(lenient.removed_observations, 0U);
  const auto strict = FilterSubproblem(subproblem, 4.5, 0.0);
  EXPECT_EQ(strict.removed_observations, 1U);
  EXPECT_EQ(strict.removed_tracks, 0U);
  EXPECT_EQ(strict.subproblem.scene.tracks[0].observations[2].ref.image, ImageId(3));
}

TEST(FilterSubproblem, RemovesPointsBehindTheirBearing) {
  Subproblem subproblem = MakeSubproblem();
  subproblem.scene.tracks[0].point_in_world.z() *= -1.0;
  const auto filtered = FilterSubproblem(subproblem, 4.0, 0.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
  EXPECT_EQ(filtered.removed_tracks, 1U);
}

TEST(FilterSubproblem, RemovesPointsUnderSmallAngles) {
  const Subproblem subproblem = MakeSubproblem();
  const auto filtered = FilterSubproblem(subproblem, 4.0, kMinAngle_rad);
  ASSERT_EQ(filtered.subproblem.scene.tracks.size(), 1U);
  EXPECT_EQ(filtered.subproblem.scene.tracks[0].point_in_world.z(), 5.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
}

TEST(FilterSubproblem, AsksForLessWhereAllIsSeenUnderSmallAngles) {
  // Nothing is near, and the last of three points, at 5 km, is seen under a tenth of the usual
  // angle.
  Subproblem subproblem = MakeSubproblem();
  std::vector<Track>& tracks = subproblem.scene.tracks;
  tracks = {tracks[1], tracks[1], tracks[1]};
  tracks[2].point_in_world.z() = 5000.0;
  for (uint32_t t = 0; t < 3; ++t) {
    for (Observation& seen : tracks[t].observations) seen.ref.feature = t;
  }
  const auto filtered = FilterSubproblem(subproblem, 4.0, kMinAngle_rad);
  EXPECT_EQ(filtered.removed_tracks, 1U);
  ASSERT_EQ(filtered.subproblem.scene.tracks.size(), 2U);
  EXPECT_EQ(filtered.subproblem.scene.tracks[1].point_in_world.z(), 500.0);
}

TEST(FilterSubproblem, JudgesTheObservationsOfSplitTracksAlone) {
  Subproblem subproblem = MakeSubproblem();
  Track part = subproblem.scene.tracks[1];
  part.observations.resize(2);
  part.observations[0].bearing = -part.observations[0].bearing;
  subproblem.split = {{.id = 3, .part = part}, {.id = 4, .part = part}};
  subproblem.split[1].part.observations.resize(1);
  const auto filtered = FilterSubproblem(subproblem, 4.0, kMinAngle_rad);
  ASSERT_EQ(filtered.subproblem.split.size(), 1U);
  EXPECT_EQ(filtered.subproblem.split[0].id, 3U);
  EXPECT_EQ(filtered.subproblem.split[0].part.observations.size(), 1U);
}

}  // namespace
}  // namespace orbweave
