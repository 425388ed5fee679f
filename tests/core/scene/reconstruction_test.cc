// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/reconstruction.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

Reconstruction RandomReconstruction(Random& random) {
  Reconstruction reconstruction;
  for (uint32_t i = 0; i < 5; ++i) {
    reconstruction.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(testing::RandomRotation(random), testing::RandomPoint(random, 0.0, 5.0));
  }
  for (uint32_t t = 0; t < 20; ++t) {
    Track track{.point_in_world = testing::RandomPoint(random, 10.0, 20.0)};
    for (const uint32_t i : {t % 4, t % 4 + 1}) {
      track.observations.push_back({.ref = {ImageId(i), t}});
    }
    reconstruction.tracks.push_back(std::move(track));
  }
  return reconstruction;
}

TEST(Reconstruction, CountsObservations) {
  Random random(uint64_t{1});
  EXPECT_EQ(RandomReconstruction(random).NumObservations(), 40U);
  EXPECT_EQ(Reconstruction{}.NumObservations(), 0U);
}

TEST(Reconstruction, SortsTracksByName) {
  Random random(uint64_t{2});
  Reconstruction reconstruction = RandomReconstruction(random);
  reconstruction.SortTracks();
  for (size_t t = 1; t < reconstruction.tracks.size(); ++t) {
    EXPECT_LT(reconstruction.tracks[t - 1].Name(), reconstruction.tracks[t].Name());
  }
}

TEST(Transformed, ChangesNoBearing) {
  Random random(uint64_t{3});
  const Reconstruction before = RandomReconstruction(random);
  const Sim3 b_from_world{2.5, testing::RandomRotation(random), {7.0, 8.0, 9.0}};
  const Reconstruction after = Transformed(b_from_world, before);
  for (size_t t = 0; t < before.tracks.size(); ++t) {
    EXPECT_LT(
        (after.tracks[t].point_in_world - b_from_world * before.tracks[t].point_in_world).norm(),
        1e-12);
    for (const Observation& observation : before.tracks[t].observations) {
      const ImageId id = observation.ref.image;
      const Eigen::Vector3d seen_before =
          testing::BearingOf(before.images.at(id).cam_from_world, before.tracks[t].point_in_world);
      const Eigen::Vector3d seen_after =
          testing::BearingOf(after.images.at(id).cam_from_world, after.tracks[t].point_in_world);
      EXPECT_LT(AngleBetween(seen_before, seen_after), 1e-12);
    }
  }
}

TEST(Transformed, GoesBackByTheInverse) {
  Random random(uint64_t{4});
  const Reconstruction before = RandomReconstruction(random);
  const Sim3 b_from_world{0.3, testing::RandomRotation(random), {-7.0, 8.0, 2.0}};
  const Reconstruction back =
      Transformed(b_from_world.Inverse(), Transformed(b_from_world, before));
  for (const auto& [id, image] : before.images) {
    const Rigid3& pose = back.images.at(id).cam_from_world;
    EXPECT_LT((pose.Centre() - image.cam_from_world.Centre()).norm(), 1e-12);
    EXPECT_LT(testing::RotationError(pose.rotation, image.cam_from_world.rotation), 1e-12);
  }
}

}  // namespace
}  // namespace orbweave
