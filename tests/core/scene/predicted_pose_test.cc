// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/predicted_pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::RandomRotation;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Three panoramas, each turned as it likes, and what pairs say of them.
struct Three {
  Rigid3 a_from_world{};
  Rigid3 m_from_world{};
  Rigid3 b_from_world{};

  Three(Random& random, const Vector3d& m, const Vector3d& b)
      : a_from_world(Rigid3::FromCentre(RandomRotation(random), Vector3d::Zero())),
        m_from_world(Rigid3::FromCentre(RandomRotation(random), m)),
        b_from_world(Rigid3::FromCentre(RandomRotation(random), b)) {}

  /// With a baseline of length one, as pairs have.
  static Rigid3 Between(const Rigid3& from, const Rigid3& to) {
    Rigid3 pose = to * from.Inverse();
    pose.translation.normalize();
    return pose;
  }
  [[nodiscard]] PredictedPose Predicted() const {
    return PredictPose(Between(a_from_world, m_from_world), Between(m_from_world, b_from_world));
  }
  [[nodiscard]] Rigid3 Pose() const { return Between(a_from_world, b_from_world); }
};

TEST(PredictedPose, HoldsThePoseWhateverTheLengthsAre) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d way = testing::RandomDirection(random);
    const Vector3d turn = testing::RandomDirection(random);
    const Vector3d m = random.Uniform(0.2, 30.0) * way;
    const Three three(random, m, m + random.Uniform(0.2, 30.0) * (way + 0.8 * turn));
    EXPECT_LT(three.Predicted().TurnedFrom(three.Pose()), 1e-9) << trial;
    EXPECT_LT(three.Predicted().LeadsPast(three.Pose()), 1e-7) << trial;
    EXPECT_TRUE(three.Predicted().AgreesWith(three.Pose())) << trial;
  }
}

TEST(PredictedPose, OfAStraightWayIsADirection) {
  Random random(2);
  const Three three(random, {0.0, 0.0, 3.0}, {0.0, 0.0, 7.0});
  const Three aside(random, {0.0, 0.0, 3.0}, {3.5, 0.0, 7.0});
  PredictedPose predicted = three.Predicted();
  EXPECT_LT(AngleBetween(predicted.first, predicted.last), 1e-7);
  Rigid3 pose = three.Pose();
  const Eigen::Quaterniond tilt = RotationFromVector(20.0 * kDegree * Vector3d::UnitX());
  pose.translation = tilt * pose.translation;
  EXPECT_GT(predicted.LeadsPast(pose), 5.0 * kDegree);
  pose.translation = -three.Pose().translation;
  EXPECT_NEAR(predicted.LeadsPast(pose), std::numbers::pi, 1e-6);
  EXPECT_FALSE(predicted.AgreesWith(pose));
  EXPECT_GT(AngleBetween(aside.Predicted().first, aside.Predicted().last), 30.0 * kDegree);
}

/// Between the two directions, beyond either of them, and beside their plane.
TEST(PredictedPose, MeasuresHowFarABaselineLeadsPast) {
  const PredictedPose predicted{.first = Vector3d::UnitX(), .last = Vector3d::UnitY()};
  const auto past_deg = [&](const Vector3d& to_b) {
    return predicted.LeadsPast({Eigen::Quaterniond::Identity(), -to_b.normalized()}) / kDegree;
  };
  EXPECT_NEAR(past_deg({1.0, 2.0, 0.0}), 0.0, 1e-9);
  EXPECT_NEAR(past_deg({1.0, -1.0, 0.0}), 45.0, 1e-9);
  EXPECT_NEAR(past_deg({-1.0, 1.0, 0.0}), 45.0, 1e-9);
  EXPECT_NEAR(past_deg({1.0, 1.0, std::sqrt(2.0)}), 45.0, 1e-9);
  EXPECT_NEAR(past_deg({-1.0, -1.0, 0.0}), 135.0, 1e-9);
}

TEST(PredictedPose, DisagreesWithAnotherTurn) {
  Random random(3);
  const Three three(random, {0.0, 0.0, 3.0}, {1.0, 0.0, 7.0});
  const Vector3d axis = testing::RandomDirection(random);
  for (const double turned_deg : {1.0, 2.0, 4.0, 90.0, 180.0}) {
    // About a's centre, so that b lies where it did.
    const Rigid3 turned =
        Rigid3::FromCentre(three.Pose().rotation * RotationFromVector(turned_deg * kDegree * axis),
                           three.Pose().Centre());
    EXPECT_NEAR(three.Predicted().TurnedFrom(turned), turned_deg * kDegree, 1e-6);
    EXPECT_EQ(three.Predicted().AgreesWith(turned), turned_deg < 2.5) << turned_deg;
  }
}

}  // namespace
}  // namespace orbweave
