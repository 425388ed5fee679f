// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/find_rival_direction.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 2048.0;
constexpr double kNoEvidence = -4.0;
const Vector3d kCentreOfB(0.3, 0.0, 7.0);
const Vector3d kWindow(0.0, 0.0, 9.0);

/// Points seen from the origin and from kCentreOfB, and what of them is matched.
struct Scene {
  std::vector<Vector3d> in_a{};
  std::vector<Vector3d> in_b{};
  std::vector<FeatureMatch> matches{};
  TwoViewGeometry geometry{.kind = TwoViewKind::kGeneral,
                           .b_from_a = {Eigen::Quaterniond::Identity(), -kCentreOfB.normalized()}};
  Random random{7};

  void Add(const Vector3d& from_a, const Vector3d& from_b, bool is_inlier) {
    const auto i = static_cast<uint32_t>(in_a.size());
    in_a.push_back(from_a.normalized());
    in_b.push_back((from_b - kCentreOfB).normalized());
    matches.push_back({i, i});
    if (is_inlier) geometry.inliers.push_back({i, i});
  }
  [[nodiscard]] Vector3d OnFacade() {
    return {6.0, random.Uniform(-3.0, 3.0), random.Uniform(-8.0, 8.0)};
  }
  void AddFacade(int count) {
    for (int i = 0; i < count; ++i) {
      const Vector3d point = OnFacade();
      Add(point, point, true);
    }
  }
  void AddWindowsOneFurtherOn(int count) {
    for (int i = 0; i < count; ++i) {
      const Vector3d point = OnFacade();
      Add(point, point + kWindow, false);
    }
  }
  void AddWrong(int count) {
    for (int i = 0; i < count; ++i) Add(OnFacade(), OnFacade(), false);
  }
  void TurnEachPanorama() {
    const Eigen::Quaterniond turn_a = RotationFromVector({0.4, -2.0, 1.1});
    const Eigen::Quaterniond turn_b = RotationFromVector({-1.3, 0.2, 2.2});
    for (Vector3d& bearing : in_a) bearing = turn_a * bearing;
    for (Vector3d& bearing : in_b) bearing = turn_b * bearing;
    geometry.b_from_a = {turn_b * geometry.b_from_a.rotation * turn_a.conjugate(),
                         turn_b * geometry.b_from_a.translation};
  }
  [[nodiscard]] double Rival() const {
    return FindRivalDirection(in_a, in_b, matches, geometry, kMaxErrorRad, 3).log10_false_alarms;
  }
};

TEST(FindRivalDirection, IsThatOfWindowsMatchedOneFurtherOn) {
  Scene scene;
  scene.AddFacade(300);
  scene.AddWindowsOneFurtherOn(60);
  scene.AddWrong(40);
  EXPECT_LT(scene.Rival(), -20.0);
}

TEST(FindRivalDirection, IsThatOfTheCameraWhereMostWindowsAreMatchedOneFurtherOn) {
  Scene scene;
  scene.AddFacade(60);
  scene.AddWindowsOneFurtherOn(300);
  scene.geometry.inliers.assign(scene.matches.begin() + 60, scene.matches.end());
  scene.geometry.b_from_a.translation = (kWindow - kCentreOfB).normalized();
  EXPECT_LT(scene.Rival(), -20.0);
}

TEST(FindRivalDirection, IsNoneWhereWhatDoesNotFitIsWrong) {
  Scene scene;
  scene.AddFacade(300);
  EXPECT_EQ(scene.Rival(), 0.0);
  scene.AddWrong(80);
  EXPECT_GT(scene.Rival(), kNoEvidence);
}

TEST(FindRivalDirection, IsNoneOfWhatIsFar) {
  Scene scene;
  scene.AddFacade(300);
  for (int i = 0; i < 80; ++i) {
    const Vector3d far = 1e5 * scene.OnFacade();
    scene.Add(far, far, false);
  }
  EXPECT_EQ(scene.Rival(), 0.0);
}

TEST(FindRivalDirection, DoesNotDependOnHowPanoramasAreTurned) {
  Scene scene;
  scene.AddFacade(300);
  scene.AddWindowsOneFurtherOn(60);
  scene.AddWrong(40);
  const double upright = scene.Rival();
  scene.TurnEachPanorama();
  EXPECT_NEAR(scene.Rival(), upright, 1e-6 * std::abs(upright));
}

}  // namespace
}  // namespace orbweave
