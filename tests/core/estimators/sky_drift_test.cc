// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/sky_drift.h"

#include <gtest/gtest.h>

#include "core/estimators/two_view_inliers.h"
#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomDirection;
using testing::WithNoise;

constexpr double kSigmaRad = 1e-3;
constexpr double kMaxErrorRad = 4.7e-3;

BearingPairs Arrange(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < a.size(); ++i) matches.push_back({i, i});
  return ArrangePairs(a, b, matches, 1);
}

/// A step of 8 m between facades 8 m to both sides, below clouds that have turned by `drift_rad`.
struct Street {
  Rigid3 b_from_a{};
  BearingPairs scene{};
  BearingPairs far{};
};

Street MakeStreet(uint64_t seed, size_t facade_points, const Vector3d& drift_rad) {
  Random random(seed);
  Street street;
  street.b_from_a = Rigid3::FromCentre(RotationFromVector({0.01, random.Uniform(-3.0, 3.0), -0.02}),
                                       Vector3d(0.0, 0.0, 1.0));
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
  for (size_t i = 0; i < facade_points; ++i) {
    const Vector3d X(
        random.Uniform() < 0.5 ? -1.0 : 1.0, random.Uniform(-1.5, 0.25), random.Uniform(-2.5, 3.5));
    a.push_back(WithNoise(random, X.normalized(), kSigmaRad));
    b.push_back(WithNoise(random, BearingOf(street.b_from_a, X), kSigmaRad));
  }
  street.scene = Arrange(a, b);
  a.clear();
  b.clear();
  const Eigen::Quaterniond turn = RotationFromVector(drift_rad) * street.b_from_a.rotation;
  for (int i = 0; i < 200; ++i) {
    const Vector3d ray(random.Uniform(-2.0, 2.0), -1.0, random.Uniform(-2.0, 2.0));
    a.push_back(WithNoise(random, ray.normalized(), kSigmaRad));
    b.push_back(WithNoise(random, turn * ray.normalized(), kSigmaRad));
  }
  street.far = Arrange(a, b);
  street.b_from_a = RefinePose(street.scene, AllOf(street.scene), street.b_from_a, kMaxErrorRad);
  return street;
}

SkyDrift Measure(const Street& street) {
  return MeasureSkyDrift(street.far, street.scene, street.b_from_a, kMaxErrorRad);
}

TEST(SkyDrift, IsTheTurnOfWhatIsFar) {
  Random random(3);
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const Vector3d drift_rad = 0.004 * RandomDirection(random);
    const SkyDrift drift = Measure(MakeStreet(seed, 300, drift_rad));
    EXPECT_LT((drift.turn_rad - drift_rad).norm(), 1.5e-3) << seed;
    EXPECT_TRUE(drift.IsClear()) << seed;
  }
}

TEST(SkyDrift, IsNotClearWhereNothingTurnsHoweverFewSayHowTheCamerasHave) {
  for (const size_t facade_points : {size_t{15}, size_t{40}, size_t{300}}) {
    int clear = 0;
    for (uint64_t seed = 0; seed < 300; ++seed)
      clear += Measure(MakeStreet(seed, facade_points, Vector3d::Zero())).IsClear() ? 1 : 0;
    EXPECT_LE(clear, facade_points < 20 ? 12 : 3) << facade_points;
  }
}

TEST(SkyDrift, ErrorsAreAsLargeAsItsCovarianceSays) {
  const Vector3d drift_rad(0.001, -0.002, 0.003);
  double squares = 0.0;
  constexpr int kStreets = 200;
  for (uint64_t seed = 0; seed < kStreets; ++seed) {
    const SkyDrift drift = Measure(MakeStreet(seed, 100, drift_rad));
    const Vector3d error = drift.turn_rad - drift_rad;
    squares += error.dot(drift.covariance.inverse() * error);
  }
  EXPECT_NEAR(squares / (3.0 * kStreets), 1.0, 0.25);
}

TEST(SkyDrift, IsNeverClearWhereTheSceneLeavesTheTurnOpen) {
  Street street = MakeStreet(5, 300, Vector3d(0.0, 0.0, 0.004));
  const std::vector<uint32_t> few = {0, 1, 2, 3};
  street.scene = Subset(street.scene, few);
  EXPECT_FALSE(Measure(street).IsClear());
}

}  // namespace
}  // namespace orbweave
