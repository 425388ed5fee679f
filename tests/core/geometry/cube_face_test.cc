// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/cube_face.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomDirection;

constexpr PinholeFace kFace = {640};

Vector3d AxisInCamera(int face, const Vector3d& axis_in_face) {
  return FaceFromCamera(face).transpose() * axis_in_face;
}

/// Solid angle of a triangle of directions (Van Oosterom and Strackee, 1983).
double SolidAngle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

TEST(CubeFace, ComesInTheOrderFrontRightBackLeftUpDown) {
  const std::array<Vector3d, kCubeFaces> out = {Vector3d::UnitZ(),
                                                Vector3d::UnitX(),
                                                -Vector3d::UnitZ(),
                                                -Vector3d::UnitX(),
                                                -Vector3d::UnitY(),
                                                Vector3d::UnitY()};
  for (int face = 0; face < kCubeFaces; ++face) {
    const Vector3d& axis = out[static_cast<size_t>(face)];
    EXPECT_EQ(AxisInCamera(face, Vector3d::UnitZ()), axis) << face;
    EXPECT_EQ(FaceOf(axis), face);
    EXPECT_EQ(FaceOf(1e-3 * axis), face);
  }
}

TEST(CubeFace, KeepsTheFourFacesRoundTheHorizonUprightAndTheirEdgesJoined) {
  for (int face = 0; face < 4; ++face) {
    EXPECT_EQ(AxisInCamera(face, Vector3d::UnitY()), Vector3d::UnitY()) << face;
    const int next = (face + 1) % 4;  // right edge of one, left edge of the next
    EXPECT_EQ(AxisInCamera(face, {1, 0.3, 1}), AxisInCamera(next, {-1, 0.3, 1})) << face;
  }
}

TEST(CubeFace, ShowsUpAndDownAsWhoTiltsTheHeadFromTheFront) {
  EXPECT_EQ(AxisInCamera(0, {0.2, -1, 1}), AxisInCamera(4, {0.2, 1, 1}));
  EXPECT_EQ(AxisInCamera(0, {0.2, 1, 1}), AxisInCamera(5, {0.2, -1, 1}));
}

TEST(CubeFace, TurnsAndNeverMirrors) {
  for (int face = 0; face < kCubeFaces; ++face) {
    const Matrix3d& R = FaceFromCamera(face);
    EXPECT_EQ(R * R.transpose(), Matrix3d::Identity());
    EXPECT_EQ(R.determinant(), 1.0);
  }
}

TEST(CubeFace, ComesBackFromSphereToFaceToSphere) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d bearing = RandomDirection(random);
    const int face = FaceOf(bearing);
    const Vector2d pixel = kFace.PixelFromBearing(FaceFromCamera(face) * bearing);
    const Vector3d back = FaceFromCamera(face).transpose() * kFace.BearingFromPixel(pixel);
    EXPECT_LT((back - bearing).norm(), 1e-14);
    EXPECT_LT((kFace.PixelFromBearing(5.0 * FaceFromCamera(face) * bearing) - pixel).norm(), 1e-9);
  }
}

TEST(CubeFace, GivesEachDirectionToExactlyOneFace) {
  Random random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d bearing = RandomDirection(random);
    int holders = 0;
    for (int face = 0; face < kCubeFaces; ++face) {
      const Vector3d in_face = FaceFromCamera(face) * bearing;
      const Vector2d pixel = kFace.PixelFromBearing(in_face);
      const bool inside =
          in_face.z() > 0.0 && pixel.minCoeff() >= 0.0 && pixel.maxCoeff() <= kFace.size_px;
      holders += inside;
      if (inside) {
        EXPECT_EQ(face, FaceOf(bearing));
      }
    }
    EXPECT_EQ(holders, 1);
  }
}

TEST(CubeFace, TilesTheSphere) {
  constexpr PinholeFace kCoarse = {16};
  double sum = 0.0;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int v = 0; v < kCoarse.size_px; ++v) {
      for (int u = 0; u < kCoarse.size_px; ++u) {
        const Vector3d a = kCoarse.BearingFromPixel(Vector2d(u, v));
        const Vector3d b = kCoarse.BearingFromPixel(Vector2d(u + 1, v));
        const Vector3d c = kCoarse.BearingFromPixel(Vector2d(u + 1, v + 1));
        const Vector3d d = kCoarse.BearingFromPixel(Vector2d(u, v + 1));
        sum += SolidAngle(a, b, c) + SolidAngle(a, c, d);
        const Vector3d middle = kCoarse.BearingFromPixel(Vector2d(u + 0.5, v + 0.5));
        EXPECT_EQ(FaceOf(FaceFromCamera(face).transpose() * middle), face);
      }
    }
  }
  EXPECT_NEAR(sum, 4.0 * pi, 1e-9);
}

TEST(CubeFace, BreaksTiesBySmallerIndexAndTakesAnything) {
  EXPECT_EQ(FaceOf({1, 0, 1}), 0);
  EXPECT_EQ(FaceOf({1, 0, -1}), 1);
  EXPECT_EQ(FaceOf({-1, 1, -1}), 2);
  EXPECT_EQ(FaceOf({-1, -1, 0}), 3);
  EXPECT_EQ(FaceOf(Vector3d::Zero()), 0);
  EXPECT_EQ(FaceOf(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())), 0);
}

TEST(CubeFace, HasAxesWherePanoramasHaveThem) {
  constexpr EquirectangularCamera kCamera = {4096, 2048};
  const std::array<Vector2d, kCubeFaces> middles = {Vector2d(2048, 1024),
                                                    Vector2d(3072, 1024),
                                                    Vector2d(0, 1024),
                                                    Vector2d(1024, 1024),
                                                    Vector2d(2048, 0),
                                                    Vector2d(2048, 2048)};
  for (int face = 0; face < kCubeFaces; ++face) {
    const Vector3d seen = kCamera.BearingFromPixel(middles[static_cast<size_t>(face)]);
    EXPECT_LT(AngleBetween(seen, AxisInCamera(face, Vector3d::UnitZ())), 1e-12) << face;
  }
}

TEST(CubeFace, TurnsPosesByEquationTwelveAboutTheSameCentre) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3d centre = testing::RandomPoint(random, 0.0, 100.0);
    const Rigid3 cam_from_world = Rigid3::FromCentre(testing::RandomRotation(random), centre);
    const Vector3d point = testing::RandomPoint(random, 0.0, 100.0);
    for (int face = 0; face < kCubeFaces; ++face) {
      const Rigid3 face_from_world = FaceFromWorld(face, cam_from_world);
      EXPECT_LT((face_from_world.Centre() - centre).norm(), 1e-12);
      const Matrix3d R_P = FaceFromCamera(face) * cam_from_world.rotation.toRotationMatrix();
      EXPECT_LT((face_from_world.rotation.toRotationMatrix() - R_P).norm(), 1e-14);
      EXPECT_LT((face_from_world.translation + R_P * centre).norm(), 1e-12);
      const Vector3d in_face = FaceFromCamera(face) * (cam_from_world * point);
      EXPECT_LT((face_from_world * point - in_face).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace orbweave
