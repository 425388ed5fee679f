// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/pose_of_most_places.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kFourPxRad = 4.0 * 2.0 * std::numbers::pi / 4096.0;

Vector3d AnyDirection(Random& random) {
  return Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
}

/// An image 8 m down the street from the one registered view.
struct RepeatingStreet {
  explicit RepeatingStreet(uint64_t seed) : random(seed) {
    truth = Rigid3::FromCentre(RotationFromVector(2.0 * AnyDirection(random)), {8.0, 0.0, 0.0});
  }

  /// A point that is seen as it is from `seen_from` although it stands at `at`.
  void Add(const Vector3d& at, const Vector3d& seen_from) {
    const Rigid3 pose = Rigid3::FromCentre(truth.rotation, seen_from);
    points.nodes.push_back(static_cast<Node>(points.size()));
    points.points.push_back(static_cast<PointIndex>(points.points.size()));
    points.positions.push_back(at);
    const Vector3d noise = 0.3 * kFourPxRad * AnyDirection(random);
    points.bearings.push_back(((pose * at).normalized() + noise).normalized());
  }
  /// Right points all round.
  void AddPlaces(int count) {
    for (int i = 0; i < count; ++i)
      Add(truth.Centre() + random.Uniform(4.0, 12.0) * AnyDirection(random), truth.Centre());
  }
  /// A facade on one side whose windows are taken for those `shift_m` further on.
  void AddFacade(int count, double shift_m) {
    const Vector3d off = truth.Centre() + Vector3d(shift_m, 0.0, 0.0);
    for (int i = 0; i < count; ++i)
      Add(off + Vector3d(random.Uniform(-2.0, 2.0), random.Uniform(-2.0, 0.0), 6.0), off);
  }
  [[nodiscard]] Rigid3 OffBy(double shift_m) const {
    return Rigid3::FromCentre(truth.rotation, truth.Centre() + Vector3d(shift_m, 0.0, 0.0));
  }
  [[nodiscard]] Rigid3 PoseFrom(const Rigid3& found) const {
    return PoseOfMostPlaces(found, points, views, kFourPxRad);
  }

  Random random;
  Rigid3 truth{};
  SceneCorrespondences points{};
  std::vector<ViewMatches> views = {ViewMatches{}};
};

TEST(PoseOfMostPlaces, DoesNotFollowOneFacadeThatRepeats) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    RepeatingStreet street(seed);
    street.AddPlaces(40);
    street.AddFacade(200, 2.5);
    const Rigid3 pose = street.PoseFrom(street.OffBy(2.5));
    EXPECT_LT((pose.Centre() - street.truth.Centre()).norm(), 0.05) << "seed " << seed;
    EXPECT_LT(RotationAngle(pose.rotation * street.truth.rotation.conjugate()), 5e-3);
  }
}

TEST(PoseOfMostPlaces, KeepsWhatWasFoundWhereNothingRepeats) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    RepeatingStreet street(seed);
    street.AddPlaces(60);
    const Rigid3 pose = street.PoseFrom(street.truth);
    EXPECT_EQ(pose.translation, street.truth.translation) << "seed " << seed;
    EXPECT_EQ(pose.rotation.coeffs(), street.truth.rotation.coeffs());
  }
}

TEST(PoseOfMostPlaces, KeepsWhatWasFoundWhereWrongPointsAgreeInFewerPlaces) {
  RepeatingStreet street(3);
  street.AddPlaces(40);
  street.AddFacade(200, 2.5);
  EXPECT_EQ(street.PoseFrom(street.truth).translation, street.truth.translation);
}

TEST(PoseOfMostPlaces, NeedsAViewFromElsewhere) {
  RepeatingStreet street(4);
  street.AddPlaces(40);
  const Rigid3 off = street.OffBy(2.5);
  EXPECT_EQ(PoseOfMostPlaces(off, street.points, {}, kFourPxRad).translation, off.translation);
  street.views.front().view_from_world = off;
  EXPECT_EQ(street.PoseFrom(off).translation, off.translation);
}

TEST(HasClearlyMorePlaces, NeedsMoreThanAFewPlaces) {
  RepeatingStreet street(6);
  street.AddPlaces(40);
  street.AddFacade(200, 2.5);
  const Rigid3 off = street.OffBy(2.5);
  EXPECT_TRUE(HasClearlyMorePlaces(street.truth, off, street.points, kFourPxRad));
  EXPECT_FALSE(HasClearlyMorePlaces(off, street.truth, street.points, kFourPxRad));
  EXPECT_FALSE(HasClearlyMorePlaces(off, off, street.points, kFourPxRad));
  RepeatingStreet few(7);
  few.AddPlaces(3);
  EXPECT_FALSE(HasClearlyMorePlaces(few.truth, few.OffBy(2.5), few.points, kFourPxRad));
}

TEST(PoseOfMostPlaces, KeepsWhatWasFoundWithoutPoints) {
  const RepeatingStreet street(5);
  EXPECT_EQ(street.PoseFrom(street.truth).translation, street.truth.translation);
}

}  // namespace
}  // namespace orbweave
