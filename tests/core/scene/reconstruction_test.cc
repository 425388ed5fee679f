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

TEST(Transformed, TurnsAndScalesTheUncertaintyOfPositions) {
  Random random(uint64_t{5});
  const Eigen::Vector3d axis(1.0, 2.0, -3.0);
  Reconstruction before = RandomReconstruction(random);
  before.images[ImageId(1)].uncertainty = {axis * axis.transpose(), 0.1};
  const Sim3 b_from_world{2.5, testing::RandomRotation(random), {7.0, 8.0, 9.0}};
  const Reconstruction after = Transformed(b_from_world, before);
  const PoseUncertainty& uncertainty = *after.images.at(ImageId(1)).uncertainty;
  const Eigen::Vector3d axis_in_b = 2.5 * (b_from_world.rotation * axis);
  EXPECT_LT((uncertainty.position_covariance - axis_in_b * axis_in_b.transpose()).norm(), 1e-12);
  EXPECT_LT((uncertainty.PositionSigmas() - axis_in_b.cwiseAbs()).norm(), 1e-12);
  EXPECT_NEAR(uncertainty.PositionSigma(), axis_in_b.norm(), 1e-12);
  EXPECT_EQ(uncertainty.rotation_sigma_rad, 0.1);
  EXPECT_FALSE(after.images.at(ImageId(0)).uncertainty.has_value());
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
