// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/matches_besides_plane.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxErrorRad = 4.0 * 2.0 * std::numbers::pi / 2048.0;
const Vector3d kCentreOfB(2.5, 0.0, 0.3);

/// Points seen from the origin and from kCentreOfB, without a turn between the two.
struct Scene {
  std::vector<Vector3d> in_a{};
  std::vector<Vector3d> in_b{};
  TwoViewGeometry geometry{.b_from_a = {Eigen::Quaterniond::Identity(), -kCentreOfB.normalized()}};
  Random random{7};

  void Add(const Vector3d& point) {
    const auto i = static_cast<uint32_t>(in_a.size());
    in_a.push_back(point.normalized());
    in_b.push_back((point - kCentreOfB).normalized());
    geometry.inliers.push_back({i, i});
  }
  /// On a facade 6 m to the right.
  void AddFacade(int count) {
    for (int i = 0; i < count; ++i)
      Add({6.0, random.Uniform(-3.0, 3.0), random.Uniform(-8.0, 8.0)});
  }
  /// Trees of all depths on the other side.
  void AddTrees(int count) {
    for (int i = 0; i < count; ++i)
      Add({random.Uniform(-20.0, -4.0), random.Uniform(-3.0, 3.0), random.Uniform(-8.0, 8.0)});
  }
  [[nodiscard]] std::optional<std::vector<FeatureMatch>> Besides() const {
    const auto found =
        MatchesBesidesPlane(in_a, in_b, geometry.inliers, geometry, kMaxErrorRad, {});
    EXPECT_TRUE(found.ok()) << found.status();
    return found.value_or(std::nullopt);
  }
};

TEST(MatchesBesidesPlane, AreThoseOfTheTreesWhereAFacadeCarriesThePair) {
  Scene scene;
  scene.AddFacade(120);
  scene.AddTrees(40);
  const auto besides = scene.Besides();
  ASSERT_TRUE(besides.has_value());
  EXPECT_GT(besides->size(), 30U);
  for (const FeatureMatch& match : *besides) EXPECT_GE(match.a, 120U);
  EXPECT_TRUE(std::ranges::is_sorted(*besides, {}, &FeatureMatch::a));
}

TEST(MatchesBesidesPlane, IsNoAnswerWhereNoPlaneCarriesThePair) {
  Scene scene;
  scene.AddFacade(20);
  scene.AddTrees(140);
  EXPECT_FALSE(scene.Besides().has_value());
  EXPECT_FALSE(Scene().Besides().has_value() && !Scene().Besides()->empty());
}

TEST(MatchesBesidesPlane, TakesFarPointsForNoPlane) {
  Scene scene;
  for (int i = 0; i < 150; ++i)
    scene.Add(1e5 *
              Vector3d(6.0, scene.random.Uniform(-3.0, 3.0), scene.random.Uniform(-8.0, 8.0)));
  scene.AddTrees(20);
  EXPECT_FALSE(scene.Besides().has_value());
}

}  // namespace
}  // namespace orbweave
