// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/fuse_poses.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

PoseEstimate Estimate(const Rigid3& pose, double weight = 100.0, bool loose = false) {
  return {.cam_from_world = pose, .loose = loose, .weight = weight};
}

Rigid3 RandomPose(Random& random) {
  return Rigid3::FromCentre(testing::RandomRotation(random),
                            testing::RandomPoint(random, 0.0, 50.0));
}

Rigid3 Disturbed(const Rigid3& pose, double sigma, Random& random) {
  const auto noise = [&] {
    return Eigen::Vector3d(sigma *
                           Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  };
  return Rigid3::FromCentre(RotationFromVector(noise()) * pose.rotation, pose.Centre() + noise());
}

TEST(FusePoses, KeepsASingleEstimateToTheBit) {
  Random random(1);
  const Rigid3 pose = RandomPose(random);
  const auto images = FusePoses({{ImageId(4), {Estimate(pose)}}});
  EXPECT_EQ(images.at(ImageId(4)).cam_from_world.translation, pose.translation);
  EXPECT_EQ(images.at(ImageId(4)).cam_from_world.rotation.coeffs(), pose.rotation.coeffs());
  EXPECT_FALSE(images.at(ImageId(4)).loose);
}

TEST(FusePoses, MeetsInTheMiddleOfTwoEqualEstimates) {
  const Rigid3 left = Rigid3::FromCentre(RotationFromVector({0.0, 0.1, 0.0}), {1.0, 0.0, 0.0});
  const Rigid3 right = Rigid3::FromCentre(RotationFromVector({0.0, -0.1, 0.0}), {3.0, 0.0, 0.0});
  const auto images = FusePoses({{ImageId(0), {Estimate(left), Estimate(right)}}});
  const Rigid3& mean = images.at(ImageId(0)).cam_from_world;
  EXPECT_LT((mean.Centre() - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_LT(RotationAngle(mean.rotation), 1e-9);
}

TEST(FusePoses, GivesLittleToAnEstimateFarOff) {
  Random random(2);
  PoseEstimates estimates;
  std::vector<Rigid3> truth;
  for (uint32_t i = 0; i < 20; ++i) {
    truth.push_back(RandomPose(random));
    estimates[ImageId(i)] = {Estimate(Disturbed(truth[i], 0.01, random), 100.0),
                             Estimate(Disturbed(truth[i], 0.01, random), 90.0)};
  }
  estimates[ImageId(7)].push_back(Estimate(RandomPose(random), 80.0));
  estimates[ImageId(9)][1].cam_from_world = RandomPose(random);
  const auto images = FusePoses(estimates);
  for (const uint32_t i : {3U, 7U, 9U}) {
    const Rigid3& fused = images.at(ImageId(i)).cam_from_world;
    EXPECT_LT((fused.Centre() - truth[i].Centre()).norm(), 0.15) << i;
    EXPECT_LT(testing::RotationError(fused.rotation, truth[i].rotation), 0.15) << i;
  }
}

TEST(FusePoses, TurnsWithTheWorld) {
  Random random(3);
  const Sim3 turned_from_world{2.5, testing::RandomRotation(random), {5.0, 6.0, 7.0}};
  PoseEstimates estimates;
  PoseEstimates turned;
  for (uint32_t i = 0; i < 10; ++i) {
    const Rigid3 pose = RandomPose(random);
    for (int k = 0; k < 3; ++k) {
      const Rigid3 estimate = Disturbed(pose, 0.01, random);
      estimates[ImageId(i)].push_back(Estimate(estimate, 10.0 + k));
      turned[ImageId(i)].push_back(
          Estimate(TransformCamera(turned_from_world, estimate), 10.0 + k));
    }
  }
  const auto images = FusePoses(estimates);
  const auto turned_images = FusePoses(turned);
  for (const auto& [id, image] : images) {
    const Rigid3 expected = TransformCamera(turned_from_world, image.cam_from_world);
    const Rigid3& found = turned_images.at(id).cam_from_world;
    EXPECT_LT((found.Centre() - expected.Centre()).norm(), 1e-9);
    EXPECT_LT(testing::RotationError(found.rotation, expected.rotation), 1e-9);
  }
}

TEST(FusePoses, ListensToLooseEstimatesOnlyWithoutOthers) {
  Random random(4);
  const Rigid3 firm = RandomPose(random);
  const auto images =
      FusePoses({{ImageId(0), {Estimate(RandomPose(random), 500.0, true), Estimate(firm)}},
                 {ImageId(1), {Estimate(firm, 1.0, true)}}});
  EXPECT_EQ(images.at(ImageId(0)).cam_from_world.translation, firm.translation);
  EXPECT_FALSE(images.at(ImageId(0)).loose);
  EXPECT_TRUE(images.at(ImageId(1)).loose);
}

}  // namespace
}  // namespace orbweave
