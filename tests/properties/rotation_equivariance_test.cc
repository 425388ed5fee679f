// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// The law of the sphere: turn a camera and its bearings, and every answer turns with them. Nothing
/// may prefer the seam, the poles or the front. Each suite applies the law to one function over
/// random turns.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/estimators/estimate_absolute_pose.h"
#include "core/estimators/estimate_two_view.h"
#include "core/estimators/triangulate_rays.h"
#include "core/geometry/eight_point.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/essential.h"
#include "core/geometry/five_point.h"
#include "core/geometry/p3p.h"
#include "core/geometry/ray_maps.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::MakeResectionWorld;
using testing::MakeTrackWorld;
using testing::MakeTwoViewWorld;
using testing::RandomRotation;
using testing::RotationError;

constexpr double kMaxErrorRad = 4.7e-3;

class RotationEquivariance : public ::testing::TestWithParam<uint64_t> {
 protected:
  Random random_{GetParam() + 1000};
  Quaterniond turn_a_ = RandomRotation(random_);
  Quaterniond turn_b_ = RandomRotation(random_);
};

std::vector<Vector3d> Turned(const Quaterniond& turn, std::vector<Vector3d> bearings) {
  for (Vector3d& bearing : bearings) bearing = turn * bearing;
  return bearings;
}

/// Whether every essential matrix of `after` is turn_b E turn_a^T of one in `before`, up to sign.
template <typename Matrices>
void ExpectTurned(const Matrices& before,
                  const Matrices& after,
                  const Quaterniond& turn_a,
                  const Quaterniond& turn_b) {
  ASSERT_EQ(before.size(), after.size());
  for (const Matrix3d& E : after) {
    double least = 10.0;
    for (const Matrix3d& original : before) {
      const Matrix3d expected =
          turn_b.toRotationMatrix() * original * turn_a.toRotationMatrix().transpose();
      least = std::min({least, (E - expected).norm(), (E + expected).norm()});
    }
    EXPECT_LT(least, 1e-5);
  }
}

TEST_P(RotationEquivariance, OfTheEpipolarAngle) {
  const auto world = MakeTwoViewWorld(GetParam(), 20, 1.0);
  const Rigid3 turned = {turn_b_ * world.b_from_a.rotation * turn_a_.conjugate(),
                         turn_b_ * world.b_from_a.translation};
  for (size_t i = 0; i < 20; ++i) {
    const Vector3d a = turn_a_ * world.bearings_a[i];
    const Vector3d b = turn_b_ * world.bearings_b[i];
    EXPECT_NEAR(SymmetricEpipolarAngle(turned, a, b),
                SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[i], world.bearings_b[i]),
                1e-9);
    EXPECT_EQ(IsInFrontOfBoth(turned, a, b),
              IsInFrontOfBoth(world.b_from_a, world.bearings_a[i], world.bearings_b[i]));
  }
}

TEST_P(RotationEquivariance, OfFivePoint) {
  const auto world = MakeTwoViewWorld(GetParam(), 5);
  const auto a = Turned(turn_a_, world.bearings_a);
  const auto b = Turned(turn_b_, world.bearings_b);
  const auto first_five = [](const std::vector<Vector3d>& v) {
    return std::span<const Vector3d, 5>(v.data(), 5);
  };
  ExpectTurned(SolveFivePoint(first_five(world.bearings_a), first_five(world.bearings_b)),
               SolveFivePoint(first_five(a), first_five(b)),
               turn_a_,
               turn_b_);
}

TEST_P(RotationEquivariance, OfEightPoint) {
  const auto world = MakeTwoViewWorld(GetParam(), 20, 0.0, 1e-3);
  const auto before = SolveEightPoint(world.bearings_a, world.bearings_b);
  const auto after =
      SolveEightPoint(Turned(turn_a_, world.bearings_a), Turned(turn_b_, world.bearings_b));
  ASSERT_TRUE(before && after);
  ExpectTurned(std::vector{*before}, std::vector{*after}, turn_a_, turn_b_);
}

TEST_P(RotationEquivariance, OfP3p) {
  const auto world = MakeResectionWorld(GetParam(), 3);
  const auto turned = Turned(turn_a_, world.bearings);
  const std::span<const Vector3d, 3> points(world.points_in_world.data(), 3);
  const auto before = SolveP3p(std::span<const Vector3d, 3>(world.bearings.data(), 3), points);
  const auto after = SolveP3p(std::span<const Vector3d, 3>(turned.data(), 3), points);
  ASSERT_EQ(before.size(), after.size());
  for (const Rigid3& pose : after) {
    double least = 10.0;
    for (const Rigid3& original : before) {
      least = std::min(least,
                       RotationError(pose.rotation, turn_a_ * original.rotation) +
                           (pose.Centre() - original.Centre()).norm());
    }
    EXPECT_LT(least, 1e-4);
  }
}

TEST_P(RotationEquivariance, OfRayMaps) {
  const auto world = MakeTwoViewWorld(GetParam(), 30);
  const auto a = Turned(turn_a_, world.bearings_a);
  const auto b = Turned(turn_b_, world.bearings_b);
  const auto before = FitRayRotation(world.bearings_a, world.bearings_b);
  const auto after = FitRayRotation(a, b);
  ASSERT_TRUE(before && after);
  const Matrix3d expected =
      turn_b_.toRotationMatrix() * *before * turn_a_.toRotationMatrix().transpose();
  EXPECT_LT((*after - expected).norm(), 1e-9);
}

TEST_P(RotationEquivariance, OfTriangulation) {
  auto world = MakeTrackWorld(GetParam(), 4, 1e-3);
  const auto before = TriangulateRays(world.cams_from_world, world.bearings);
  const Rigid3 turn = {turn_a_, Vector3d::Zero()};
  world.cams_from_world[2] = turn * world.cams_from_world[2];
  world.bearings[2] = turn_a_ * world.bearings[2];
  const auto after = TriangulateRays(world.cams_from_world, world.bearings);
  ASSERT_TRUE(before && after);
  EXPECT_LT((*before - *after).norm(), 1e-8);
}

TEST_P(RotationEquivariance, OfTriangulationInATurnedWorld) {
  auto world = MakeTrackWorld(GetParam(), 4, 1e-3);
  const auto before = TriangulateRays(world.cams_from_world, world.bearings);
  const Rigid3 world_from_turned = Rigid3{turn_a_, Vector3d(1, -2, 3)}.Inverse();
  for (Rigid3& cam : world.cams_from_world) cam = cam * world_from_turned;
  const auto after = TriangulateRays(world.cams_from_world, world.bearings);
  ASSERT_TRUE(before && after);
  EXPECT_LT((*before - world_from_turned * *after).norm(), 1e-8);
}

TEST_P(RotationEquivariance, OfAbsolutePose) {
  const auto world = MakeResectionWorld(GetParam(), 100, 0.3, 1e-3);
  const auto before =
      EstimateAbsolutePose(world.bearings, world.points_in_world, kMaxErrorRad, {}, {});
  const auto after = EstimateAbsolutePose(
      Turned(turn_a_, world.bearings), world.points_in_world, kMaxErrorRad, {}, {});
  ASSERT_TRUE(before.ok() && after.ok() && *before && *after);
  EXPECT_EQ((*before)->is_inlier, (*after)->is_inlier);
  EXPECT_LT(RotationError((*after)->cam_from_world.rotation,
                          turn_a_ * (*before)->cam_from_world.rotation),
            1e-5);
  EXPECT_LT(((*after)->cam_from_world.Centre() - (*before)->cam_from_world.Centre()).norm(), 1e-4);
}

TEST_P(RotationEquivariance, OfTwoViewGeometry) {
  const auto world = MakeTwoViewWorld(GetParam(), 150, 0.3, 1e-3);
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < 150; ++i) matches.push_back({i, i});
  const ImagePair pair = {ImageId(0), ImageId(1)};
  const auto before =
      EstimateTwoView(pair, world.bearings_a, world.bearings_b, matches, kMaxErrorRad, {}, {});
  const auto after = EstimateTwoView(pair,
                                     Turned(turn_a_, world.bearings_a),
                                     Turned(turn_b_, world.bearings_b),
                                     matches,
                                     kMaxErrorRad,
                                     {},
                                     {});
  ASSERT_TRUE(before.ok() && after.ok());
  EXPECT_EQ(before->kind, after->kind);
  EXPECT_EQ(before->inliers, after->inliers);
  EXPECT_LT(RotationError(after->b_from_a.rotation,
                          turn_b_ * before->b_from_a.rotation * turn_a_.conjugate()),
            1e-4);
  EXPECT_LT(AngleBetween(after->b_from_a.translation, turn_b_ * before->b_from_a.translation),
            1e-4);
}

INSTANTIATE_TEST_SUITE_P(Turns, RotationEquivariance, ::testing::Range(uint64_t{0}, uint64_t{20}));

}  // namespace
}  // namespace orbweave
