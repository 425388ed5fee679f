// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/refine_georeference.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/rotation.h"
#include "core/merging/georeference/tilt_inflation.h"
#include "tests/core/merging/driven_street.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::Drive;
using testing::DrivenStreet;
using testing::DriveOptions;

const Eigen::Vector3d kDown = -Eigen::Vector3d::UnitZ();

struct Pairs {
  std::vector<Eigen::Vector3d> in_world{};
  std::vector<Eigen::Vector3d> in_enu{};
  std::vector<Eigen::Vector3d> sigma_m{};

  [[nodiscard]] Sim3 Refine(const std::optional<Gravity>& gravity,
                            double inflation,
                            const Sim3& start) const {
    return RefineGeoreference({in_world, in_enu, sigma_m}, gravity, inflation, start);
  }
};

// A town of 200 m, heights within 2 m.
Pairs Town(const Sim3& enu_from_world, Random& random) {
  Pairs pairs;
  for (int i = 0; i < 50; ++i) {
    const double x = random.Uniform(-100.0, 100.0);
    const double y = random.Uniform(-100.0, 100.0);
    pairs.in_enu.emplace_back(x, y, random.Uniform(-2.0, 2.0));
    pairs.in_world.push_back(enu_from_world.Inverse() * pairs.in_enu.back());
    pairs.sigma_m.emplace_back(2.0, 2.0, 2.0);
  }
  return pairs;
}

double HeadingOf(const Sim3& enu_from_world, const Sim3& truth) {
  const Eigen::Vector3d east =
      enu_from_world.rotation * (truth.rotation.conjugate() * Eigen::Vector3d::UnitX());
  return std::atan2(east.y(), east.x());
}

TEST(RefineGeoreference, UndoesAnySimilarityWithoutGravity) {
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Sim3 truth{0.4, testing::RandomRotation(random), 30.0 * testing::RandomDirection(random)};
    const Pairs pairs = Town(truth, random);
    Sim3 start = truth;
    start.rotation = RotationFromVector(0.3 * testing::RandomDirection(random)) * start.rotation;
    start.scale *= 1.3;
    const Sim3 found = pairs.Refine(std::nullopt, 1.0, start);
    EXPECT_NEAR(found.scale, truth.scale, 1e-9);
    EXPECT_LT(found.rotation.angularDistance(truth.rotation), 1e-8);
    EXPECT_LT((found.translation - truth.translation).norm(), 1e-6);
  }
}

TEST(RefineGeoreference, LetsGravityTurnTheModelNeitherAboutTheVerticalNorInScale) {
  Random random(2);
  const Sim3 truth{2.5, testing::RandomRotation(random), {1.0, 2.0, 3.0}};
  const Pairs pairs = Town(truth, random);
  const double wrong_rad = 0.03;
  const Gravity gravity{.down_in_world = truth.rotation.conjugate() *
                                         RotationFromVector({wrong_rad, 0.0, 0.0}) * kDown,
                        .sigma_rad = 0.05,
                        .mount_share = 0.0};
  for (const double inflation : {1.0, 1e3, 1e6}) {
    const Sim3 found = pairs.Refine(gravity, inflation, truth);
    // Turned away, positions ask for a scale that is shorter by the cosine.
    EXPECT_NEAR(found.scale, truth.scale, truth.scale * wrong_rad * wrong_rad);
    EXPECT_LT(std::abs(HeadingOf(found, truth)), wrong_rad * wrong_rad);
  }
  const double followed =
      pairs.Refine(gravity, 1e8, truth).rotation.angularDistance(truth.rotation);
  EXPECT_NEAR(followed, wrong_rad, 0.1 * wrong_rad);
}

TEST(RefineGeoreference, StandsAStreetUprightAboutItsAxis) {
  Pairs pairs;
  for (int i = 0; i < 40; ++i) {
    pairs.in_world.emplace_back(3.0 * i, 0.0, 0.0);
    pairs.in_enu.emplace_back(3.0 * i, 0.0, 0.0);
    pairs.sigma_m.emplace_back(2.0, 2.0, 2.0);
  }
  const Sim3 rolled{1.0, RotationFromVector({0.4, 0.0, 0.0}), Eigen::Vector3d::Zero()};
  const Sim3 upright = pairs.Refine(Gravity{}, 1.0, rolled);
  EXPECT_LT(upright.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-6);
  const Sim3 untold = pairs.Refine(std::nullopt, 1.0, rolled);
  EXPECT_LT(untold.rotation.angularDistance(rolled.rotation), 1e-6);
}

double InflationOf(const DrivenStreet& street, const Sim3& enu_from_world) {
  const std::vector<GnssDrive> drives = GnssDrivesOf(street.model, street.manifest);
  std::vector<Eigen::Vector3d> positions;
  for (const ImageRecord& image : street.manifest.images)
    positions.push_back(*image.prior.position_in_enu);
  return TiltInflation(
      drives, positions, EstimateGravity(street.model, street.manifest), enu_from_world);
}

TEST(TiltInflation, IsLittleWhereErrorsAreIndependent) {
  for (const uint64_t seed : {1U, 2U, 3U})
    EXPECT_LT(InflationOf(Drive({.panoramas = 100, .turn_rad = 1.5, .sigma_m = 2.0}, seed), {}),
              6.0);
}

TEST(TiltInflation, FindsThatNeighboursAreOffTogether) {
  Random random(4);
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 1.5, .sigma_m = 0.5}, 4);
  double error_m = 0.0;
  for (ImageRecord& image : street.manifest.images) {
    error_m = 0.95 * error_m + 1.2 * random.Normal();
    image.prior.position_in_enu->z() += error_m;
  }
  EXPECT_GT(InflationOf(street, {}), 10.0);
}

TEST(TiltInflation, IsThatOfTheGroundWhereNoHeightIsKnown) {
  Random random(4);
  DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 1.5, .sigma_m = 0.5}, 4);
  double error_m = 0.0;
  for (ImageRecord& image : street.manifest.images) {
    image.prior.vertical_sigma_m = kUnknownHeightSigma_m;
    error_m = 0.95 * error_m + 1.2 * random.Normal();
    image.prior.position_in_enu->x() += error_m;
    image.prior.position_in_enu->y() -= error_m;
  }
  EXPECT_GT(InflationOf(street, {}), 5.0);
  street = Drive({.panoramas = 100, .turn_rad = 1.5, .sigma_m = 2.0}, 4);
  for (ImageRecord& image : street.manifest.images)
    image.prior.vertical_sigma_m = kUnknownHeightSigma_m;
  EXPECT_LT(InflationOf(street, {}), 5.0);
}

TEST(TiltInflation, IsNotOneBecauseFewHeightsSayNothing) {
  const DriveOptions hilly{
      .panoramas = 200, .step_m = 2.0, .slope_rad = 0.2, .hill_panoramas = 100};
  DrivenStreet street = Drive(hilly, 4);
  Random random(4);
  double error_m = 0.0;
  for (ImageRecord& image : street.manifest.images) {
    PosePrior& prior = image.prior;
    prior.horizontal_sigma_m = 4.0;
    prior.vertical_sigma_m = image.id.value % 50 == 25 ? 100.0 : kUnknownHeightSigma_m;
    error_m = 0.97 * error_m + random.Normal();
    *prior.position_in_enu += Eigen::Vector3d(error_m, -error_m, 10.0 * random.Normal());
  }
  EXPECT_GT(InflationOf(street, {}), 3.0);
}

TEST(TiltInflation, DoesNotTakeATiltOfTheModelForErrors) {
  const DrivenStreet street = Drive({.panoramas = 100, .turn_rad = 1.5}, 5);
  const Sim3 tilted{1.0, RotationFromVector({0.02, -0.01, 0.0}), Eigen::Vector3d::Zero()};
  // But for what a slope of two in a hundred tells by places along the ground.
  EXPECT_LT(InflationOf(street, tilted), 1.01);
}

}  // namespace
}  // namespace orbweave
