// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/compare_with_claims.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "core/geometry/sim3.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr double kSigma = 0.02;

struct Cameras {
  std::vector<Rigid3> truth{};
  std::vector<Rigid3> model{};
  std::vector<Eigen::Vector3d> sigmas{};
};

/// Errors of kSigma along x, twice and three times as much along y and z, as claimed.
Cameras SomeCameras(Random& random) {
  Cameras cameras;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Quaterniond turn = testing::RandomRotation(random);
    const Eigen::Vector3d centre(2.0 * i, random.Normal(), random.Normal());
    const Eigen::Vector3d sigma(kSigma, 2.0 * kSigma, 3.0 * kSigma);
    const Eigen::Vector3d error(random.Normal(), random.Normal(), random.Normal());
    cameras.truth.push_back(Rigid3::FromCentre(turn, centre));
    cameras.model.push_back(Rigid3::FromCentre(turn, centre + error.cwiseProduct(sigma)));
    cameras.sigmas.push_back(sigma);
  }
  return cameras;
}

TEST(CompareWithClaims, TrueSigmasGiveOnePerAxis) {
  Random random(1);
  Cameras cameras = SomeCameras(random);
  const auto errors = CompareWithClaims(cameras.model, cameras.sigmas, cameras.truth);
  ASSERT_TRUE(errors.has_value());
  EXPECT_FALSE(errors->is_relative);
  EXPECT_EQ(errors->cameras, 400U);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(errors->squared_over_variance[axis], 1.0, 0.3);
  for (Eigen::Vector3d& sigma : cameras.sigmas) sigma /= 3.0;
  const auto proud = CompareWithClaims(cameras.model, cameras.sigmas, cameras.truth);
  EXPECT_NEAR(proud->squared_over_variance.x(), 9.0 * errors->squared_over_variance.x(), 1e-9);
}

TEST(CompareWithClaims, RelativeSigmasReferToTheHeldCameraInAnyFrame) {
  Random random(2);
  Cameras cameras = SomeCameras(random);
  cameras.model[0] = cameras.truth[0];
  cameras.model[399] = cameras.truth[399];
  cameras.sigmas[0].setZero();
  const auto here = CompareWithClaims(cameras.model, cameras.sigmas, cameras.truth);
  const Sim3 elsewhere{3.0, testing::RandomRotation(random), {5.0, -7.0, 1.0}};
  for (Rigid3& camera : cameras.truth) camera = TransformCamera(elsewhere, camera);
  const auto there = CompareWithClaims(cameras.model, cameras.sigmas, cameras.truth);
  ASSERT_TRUE(here.has_value() && there.has_value());
  EXPECT_TRUE(there->is_relative);
  EXPECT_EQ(there->cameras, 398U);
  EXPECT_LT((there->squared_over_variance - here->squared_over_variance).norm(), 1e-6);
  EXPECT_NEAR(here->squared_over_variance.x(), 1.0, 0.3);
}

TEST(CompareWithClaims, CountsWhatIsOffByMoreThanThreeSigmasAndFiveCentimetres) {
  Random random(3);
  Cameras cameras = SomeCameras(random);
  cameras.model = cameras.truth;
  const auto misplaced = [&] {
    return CompareWithClaims(cameras.model, cameras.sigmas, cameras.truth)->misplaced;
  };
  const auto move = [&](size_t camera, double by_m) {
    cameras.model[camera] = Rigid3::FromCentre(
        cameras.model[camera].rotation,
        cameras.truth[camera].Centre() + Eigen::Vector3d(0.6 * by_m, 0.0, 0.8 * by_m));
  };
  EXPECT_EQ(misplaced(), 0U);
  const double allowed = 3.0 * cameras.sigmas[7].norm() + kMisplacedSlack;
  move(7, allowed - 1e-6);
  EXPECT_EQ(misplaced(), 0U);
  move(7, allowed + 1e-6);
  EXPECT_EQ(misplaced(), 1U);
  for (Eigen::Vector3d& sigma : cameras.sigmas) sigma *= 1.1;
  EXPECT_EQ(misplaced(), 0U);
}

TEST(CompareWithClaims, NothingToJudge) {
  EXPECT_FALSE(CompareWithClaims({}, {}, {}).has_value());
  const std::vector<Rigid3> one(1);
  const std::vector<Eigen::Vector3d> none = {Eigen::Vector3d::Zero()};
  EXPECT_FALSE(CompareWithClaims(one, none, one).has_value());
}

}  // namespace
}  // namespace orbweave
