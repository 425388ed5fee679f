// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/fit_bridge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kSigmaRad = 0.01;

Sim3 Truth() { return {2.5, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}}; }

/// Off by 0.1 rad, a fifth of the scale, and two units.
Sim3 Start() {
  return {3.0, RotationFromVector({0.06, 0.08, 0.0}) * Truth().rotation, {4.0, -9.0, 2.0}};
}

Vector3d AnyPoint(Random& random, double size) {
  return {size * random.Normal(), size * random.Normal(), size * random.Normal()};
}

BridgeSight Sight(const Rigid3& cam_from_own, const Vector3d& in_own, const Vector3d& in_other) {
  return {cam_from_own, in_other, (cam_from_own * in_own).normalized(), kSigmaRad};
}

/// Exact sights between cameras near the origins and points about them.
BridgeTerms Terms(int from_a, int from_b) {
  Random random(5);
  BridgeTerms terms;
  for (int i = 0; i < from_a; ++i) {
    const Vector3d in_b = AnyPoint(random, 5.0);
    const Rigid3 cam =
        Rigid3::FromCentre(RotationFromVector(AnyPoint(random, 1.0)), AnyPoint(random, 3.0));
    terms.from_a.push_back(Sight(cam, Truth() * in_b, in_b));
  }
  for (int i = 0; i < from_b; ++i) {
    const Vector3d in_a = AnyPoint(random, 12.0);
    const Rigid3 cam =
        Rigid3::FromCentre(RotationFromVector(AnyPoint(random, 1.0)), AnyPoint(random, 2.0));
    terms.from_b.push_back(Sight(cam, Truth().Inverse() * in_a, in_a));
  }
  return terms;
}

void ExpectTruth(const Sim3& found, double tolerance) {
  EXPECT_NEAR(found.scale / Truth().scale, 1.0, tolerance);
  EXPECT_LT(RotationAngle(found.rotation * Truth().rotation.conjugate()), tolerance);
  EXPECT_LT((found.translation - Truth().translation).norm(), 10.0 * tolerance);
}

TEST(FitBridge, FindsTheSimilarityFromSightsOfEitherSide) {
  ExpectTruth(FitBridge(Terms(20, 0), Start()).a_from_b, 1e-5);
  ExpectTruth(FitBridge(Terms(0, 20), Start()).a_from_b, 1e-5);
  const FittedBridge both = FitBridge(Terms(20, 20), Start());
  ExpectTruth(both.a_from_b, 1e-5);
  EXPECT_LT(both.cost, 1e-3);
}

TEST(FitBridge, FindsItFromATurnAndPositions) {
  BridgeTerms terms{.turns = {{Truth().rotation, 0.05}},
                    .enu_from_a = {0.7, RotationFromVector({0.0, 0.0, 1.0}), {5.0, 6.0, 7.0}}};
  for (const Vector3d& in_b : {Vector3d(0, 0, 0), Vector3d(4, 0, 1), Vector3d(-3, 2, 0)})
    terms.fixes.push_back({in_b, terms.enu_from_a * (Truth() * in_b), Vector3d(0.1, 0.1, 0.1)});
  ExpectTruth(FitBridge(terms, Start()).a_from_b, 1e-5);
}

TEST(FitBridge, ShrugsOffAQuarterOfWrongSights) {
  BridgeTerms terms = Terms(40, 40);
  for (size_t i = 0; i < terms.from_a.size(); i += 4) {
    terms.from_a[i].bearing = -terms.from_a[i].bearing;
    terms.from_b[i].bearing = -terms.from_b[i].bearing;
  }
  const Sim3 near{2.6, RotationFromVector({0.02, 0.02, 0.0}) * Truth().rotation, {3.2, -8.2, 1.1}};
  ExpectTruth(FitBridge(terms, near).a_from_b, 2e-3);
}

TEST(FitBridge, KnowsThatOneDirectionLeavesTheScaleOpen) {
  // Two cameras of b on one line seen along it: how far and how large is anybody's guess.
  BridgeTerms terms{.turns = {{Truth().rotation, 0.05}}};
  const Rigid3 cam = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), Vector3d::Zero());
  for (const double x : {0.0, 1.0}) {
    const Vector3d in_a(10.0 + x, 0.0, 0.0);
    terms.from_a.push_back(Sight(cam, in_a, Truth().Inverse() * in_a));
  }
  EXPECT_GT(FitBridge(terms, Truth()).log_scale_sigma, 1.0);
  EXPECT_LT(FitBridge(Terms(20, 20), Truth()).log_scale_sigma, 0.05);
}

TEST(FitBridge, SigmaOfTheScaleIsThatOfRepeatedFits) {
  double sum2 = 0.0;
  double claimed = 0.0;
  constexpr int kRepeats = 200;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    Random random(100 + static_cast<uint64_t>(repeat));
    BridgeTerms terms = Terms(15, 15);
    for (auto* sights : {&terms.from_a, &terms.from_b}) {
      for (BridgeSight& sight : *sights) {
        const Eigen::Vector2d noise(0.1 * kSigmaRad * random.Normal(),
                                    0.1 * kSigmaRad * random.Normal());
        sight.bearing = (sight.bearing + TangentBasis(sight.bearing) * noise).normalized();
      }
    }
    const FittedBridge fitted = FitBridge(terms, Truth());
    const double error = std::log(fitted.a_from_b.scale / Truth().scale);
    sum2 += error * error / kRepeats;
    claimed += 0.1 * fitted.log_scale_sigma / kRepeats;
  }
  EXPECT_NEAR(std::sqrt(sum2) / claimed, 1.0, 0.2);
}

TEST(FitBridge, HoldsTheScaleOfASingleCamera) {
  BridgeTerms terms = Terms(0, 20);
  for (BridgeSight& sight : terms.from_b) {
    const Vector3d ray = sight.cam_from_own.rotation.conjugate() * sight.bearing;
    sight.cam_from_own = Rigid3{};
    // Where that ray of a camera in b's origin meets a point of a.
    sight.point_in_other = Truth() * Vector3d(4.0 * ray);
    sight.bearing = ray;
  }
  terms.b_is_one_camera = true;
  const FittedBridge fitted = FitBridge(terms, {1.0, Start().rotation, Start().translation});
  EXPECT_LT((fitted.a_from_b.translation - Truth().translation).norm(), 1e-4);
  EXPECT_LT(fitted.log_scale_sigma, 0.01);
}

TEST(SightErrors, VanishAtTheTruthAndAreAnglesElsewhere) {
  const BridgeTerms terms = Terms(4, 3);
  const std::vector<double> exact = SightErrors(terms, Truth());
  ASSERT_EQ(exact.size(), 7U);
  for (const double error : exact) EXPECT_LT(error, 1e-5);
  Sim3 turned = Truth();
  turned.translation += Vector3d(0.5, 0.0, 0.0);
  for (const double error : SightErrors(terms, turned)) EXPECT_GT(error, 0.01);
}

}  // namespace
}  // namespace orbweave
