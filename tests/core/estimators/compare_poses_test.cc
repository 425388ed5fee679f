// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/compare_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/estimators/align_cameras.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::RandomPoint;
using testing::RandomRotation;
using testing::RotationError;

Sim3 AnySimilarity(Random& random) {
  return {
      std::exp(random.Uniform(-2.0, 2.0)), RandomRotation(random), RandomPoint(random, 0.0, 50.0)};
}

/// Cameras every 3 m of a street whose bends are `width_m` wide, each turned as it likes.
std::vector<Rigid3> Street(Random& random, size_t count, double width_m) {
  std::vector<Rigid3> cams;
  for (size_t i = 0; i < count; ++i) {
    const double x = 3.0 * static_cast<double>(i);
    cams.push_back(Rigid3::FromCentre(RandomRotation(random),
                                      {x, width_m * std::sin(0.05 * x), width_m * 0.01 * x}));
  }
  return cams;
}

std::vector<Rigid3> Moved(const Sim3& b_from_a, std::vector<Rigid3> cams) {
  for (Rigid3& cam : cams) cam = TransformCamera(b_from_a, cam);
  return cams;
}

TEST(AlignCameras, FindsTheSimilarityOfBentAndOfStraightStreets) {
  for (const double width_m : {20.0, 0.1, 0.0}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      Random random(seed);
      const std::vector<Rigid3> cams = Street(random, 40, width_m);
      const Sim3 truth = AnySimilarity(random);
      const auto found = AlignCameras(cams, Moved(truth, cams), {});
      ASSERT_TRUE(found.has_value()) << width_m;
      EXPECT_NEAR(found->scale / truth.scale, 1.0, 1e-9);
      EXPECT_LT(RotationError(found->rotation, truth.rotation), 1e-7);
    }
  }
}

TEST(AlignCameras, LeavesOutCamerasWithoutWeight) {
  for (const double width_m : {20.0, 0.0}) {
    Random random(1);
    const std::vector<Rigid3> cams = Street(random, 20, width_m);
    const Sim3 truth = AnySimilarity(random);
    std::vector<Rigid3> moved = Moved(truth, cams);
    moved[7] = Rigid3::FromCentre(RandomRotation(random), RandomPoint(random, 0.0, 500.0));
    std::vector<double> weights(cams.size(), 1.0);
    weights[7] = 0.0;
    const auto found = AlignCameras(cams, moved, weights);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(RotationError(found->rotation, truth.rotation), 1e-7);
  }
}

TEST(AlignCameras, GivesUpOnOnePlaceAndOnTwoCameras) {
  Random random(1);
  const std::vector<Rigid3> street = Street(random, 5, 1.0);
  std::vector<Rigid3> one_place;
  for (int i = 0; i < 5; ++i)
    one_place.push_back(Rigid3::FromCentre(RandomRotation(random), Vector3d(1.0, 2.0, 3.0)));
  EXPECT_FALSE(AlignCameras(one_place, street, {}).has_value());
  EXPECT_FALSE(AlignCameras(street, one_place, {}).has_value());
  EXPECT_FALSE(
      AlignCameras({street.data(), 2}, {street.data() + 1, 2}, std::vector<double>{}).has_value());
}

TEST(ComparePoses, FindsNoErrorInTheSameStreetInAnotherFrame) {
  for (const double width_m : {20.0, 0.0}) {
    Random random(3);
    const std::vector<Rigid3> truth = Street(random, 70, width_m);
    const auto errors = ComparePoses(Moved(AnySimilarity(random), truth), truth);
    ASSERT_TRUE(errors.has_value());
    EXPECT_LT(errors->position_max_m, 1e-6);
    EXPECT_LT(errors->rotation_max_deg, 1e-5);
    EXPECT_LT(errors->neighbour_rmse_m, 1e-6);
    EXPECT_LT(errors->window_rmse_m, 1e-6);
  }
}

TEST(ComparePoses, WindowsSeeNoiseAndNoDrift) {
  Random random(4);
  std::vector<Rigid3> truth = Street(random, 400, 20.0);
  std::vector<Rigid3> model;
  for (size_t i = 0; i < truth.size(); ++i) {
    // A scale that drifts by a ten-thousandth over the street, and a millimetre of noise per axis.
    const double drift = 1.0 + 1e-4 * static_cast<double>(i) / static_cast<double>(truth.size());
    const Vector3d noise = 1e-3 * Vector3d(random.Normal(), random.Normal(), random.Normal());
    model.push_back(Rigid3::FromCentre(truth[i].rotation, drift * truth[i].Centre() + noise));
  }
  const auto errors = ComparePoses(model, truth);
  ASSERT_TRUE(errors.has_value());
  EXPECT_GT(errors->position_rmse_m, 5e-3);
  // Of 1.73 mm of noise a similarity takes 7 of 90 freedoms: 1.66 mm. The drift adds little.
  EXPECT_GT(errors->window_rmse_m, 1.5e-3);
  EXPECT_LT(errors->window_rmse_m, 2.0e-3);
}

}  // namespace
}  // namespace orbweave
