// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/filter_block.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kWidth_px = 3600;  // ten pixels to the degree

// Four panoramas a metre apart on the x axis that see (0, 0, 5) and, far off, (0, 0, 500).
WorldBlock MakeBlock() {
  WorldBlock block;
  for (uint32_t i = 0; i < 4; ++i) {
    block.images.push_back({.id = ImageId(i), .camera = {kWidth_px, kWidth_px / 2}});
    block.scene.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1.0 * i, 0.0, 0.0});
  }
  for (uint32_t t = 0; t < 2; ++t) {
    Track track{.point_in_world = {0.0, 0.0, t == 0 ? 5.0 : 500.0}};
    for (uint32_t i = 0; i < 4; ++i) {
      const Rigid3& cam_from_world = block.scene.images.at(ImageId(i)).cam_from_world;
      track.observations.push_back(
          {.ref = {ImageId(i), t},
           .bearing = (cam_from_world * track.point_in_world).normalized()});
    }
    block.scene.tracks.push_back(track);
  }
  return block;
}

constexpr double kMinAngle_rad = 0.017;

TEST(FilterBlock, RemovesWhatIsTooFarFromItsBearing) {
  WorldBlock block = MakeBlock();
  Eigen::Vector3d& bearing = block.scene.tracks[0].observations[2].bearing;
  bearing = RotationFromVector({0.0, 0.0087, 0.0}) * bearing;  // 5 px
  const auto lenient = FilterBlock(block, 5.5, 0.0);
  EXPECT_EQ(lenient.removed_observations, 0U);
  const auto strict = FilterBlock(block, 4.5, 0.0);
  EXPECT_EQ(strict.removed_observations, 1U);
  EXPECT_EQ(strict.removed_tracks, 0U);
  EXPECT_EQ(strict.block.scene.tracks[0].observations[2].ref.image, ImageId(3));
}

TEST(FilterBlock, RemovesPointsBehindTheirBearing) {
  WorldBlock block = MakeBlock();
  block.scene.tracks[0].point_in_world.z() *= -1.0;
  const auto filtered = FilterBlock(block, 4.0, 0.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
  EXPECT_EQ(filtered.removed_tracks, 1U);
}

TEST(FilterBlock, RemovesPointsUnderSmallAngles) {
  const WorldBlock block = MakeBlock();
  const auto filtered = FilterBlock(block, 4.0, kMinAngle_rad);
  ASSERT_EQ(filtered.block.scene.tracks.size(), 1U);
  EXPECT_EQ(filtered.block.scene.tracks[0].point_in_world.z(), 5.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
}

TEST(FilterBlock, JudgesTheObservationsOfSplitTracksAlone) {
  WorldBlock block = MakeBlock();
  Track part = block.scene.tracks[1];
  part.observations.resize(2);
  part.observations[0].bearing = -part.observations[0].bearing;
  block.split = {{.id = 3, .part = part}, {.id = 4, .part = part}};
  block.split[1].part.observations.resize(1);
  const auto filtered = FilterBlock(block, 4.0, kMinAngle_rad);
  ASSERT_EQ(filtered.block.split.size(), 1U);
  EXPECT_EQ(filtered.block.split[0].id, 3U);
  EXPECT_EQ(filtered.block.split[0].part.observations.size(), 1U);
}

}  // namespace
}  // namespace orbweave
