// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_in_enu.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/positioning/turn_to_enu.h"
#include "core/mapping/positioning/upright.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kImages = 20;

/// Two legs of a street at a right angle, 8 m a step, upright cameras, exact displacements in a
/// frame turned by `turn`; positions of 1 m in east, north and up.
struct Corner {
  explicit Corner(const Eigen::Quaterniond& frame_from_walk) : turn(frame_from_walk) {
    Random random(3);
    for (uint32_t i = 0; i < kImages; ++i) {
      images.push_back(i);
      centres.emplace_back(8.0 * std::min(i, 10U), 0.0, i > 10 ? 8.0 * (i - 10.0) : 0.0);
      cams_from_world.push_back(turn.conjugate());
      ClusterImage image{.id = ImageId(i)};
      image.prior.position_in_enu =
          TrueInEnu(i) + Vector3d(random.Normal(), random.Normal(), random.Normal());
      image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = 1.0;
      problem.images.push_back(image);
    }
    displacements = {.num_nodes = kImages};
    displacements.differences.resize(kImages - 1, 3);
    displacements.weights.setOnes(kImages - 1);
    for (uint32_t i = 0; i + 1 < kImages; ++i) {
      displacements.edges.push_back({i, i + 1});
      displacements.differences.row(i) = (turn * (centres[i + 1] - centres[i])).transpose();
    }
  }
  /// x east, z north, y down.
  [[nodiscard]] Vector3d TrueInEnu(uint32_t image) const {
    const Vector3d& C = centres[image];
    return {C.x() + 30.0, C.z() - 12.0, -C.y() + 4.0};
  }
  [[nodiscard]] std::optional<EnuPlacement> Placed(double least_scatter = 1.0) const {
    const auto placed =
        PlaceInEnu(problem, images, cams_from_world, displacements, least_scatter, {});
    EXPECT_TRUE(placed.ok()) << placed.status();
    return placed.ok() ? *placed : std::nullopt;
  }

  Eigen::Quaterniond turn;
  std::vector<Vector3d> centres{};
  std::vector<ImageSlot> images{};
  std::vector<Eigen::Quaterniond> cams_from_world{};
  ClusterProblem problem{};
  DifferenceGraph displacements{};
};

const Eigen::Quaterniond kTurn = RotationFromVector({0.4, -1.1, 0.7});

double WorstInPlan(const Corner& corner, const EnuPlacement& placed) {
  double worst = 0.0;
  for (uint32_t i = 0; i < kImages; ++i) {
    const Vector3d centre = placed.centres.row(i);
    worst = std::max(worst, (centre - corner.TrueInEnu(i)).head<2>().norm());
  }
  return worst;
}

TEST(PlaceInEnu, PutsImagesWhereTheyAre) {
  const Corner corner(kTurn);
  const auto placed = corner.Placed();
  ASSERT_TRUE(placed.has_value());
  EXPECT_LT(WorstInPlan(corner, *placed), 1.5);
  EXPECT_EQ(placed->scatter, 1.0);
}

TEST(PlaceInEnu, IsNotTiltedByADriveOverAnotherDatum) {
  Corner corner(kTurn);
  for (uint32_t i = 6; i < 14; ++i) {
    corner.problem.images[i].drive = 1;
    corner.problem.images[i].prior.position_in_enu->z() += 40.0;
  }
  const auto placed = corner.Placed();
  ASSERT_TRUE(placed.has_value());
  EXPECT_LT(WorstInPlan(corner, *placed), 1.5);
  const Vector3d up = placed->enu_from_world * corner.turn * -Vector3d::UnitY();
  EXPECT_GT(up.z(), std::cos(0.02));
  EXPECT_NEAR(placed->height_offset_m[8] - placed->height_offset_m[2], 40.0, 2.0);
  EXPECT_NEAR(placed->centres(8, 2), placed->centres(2, 2), 2.0);
}

/// Of a step, against what images see.
double WorstStep(const Corner& corner, const EnuPlacement& placed) {
  double worst = 0.0;
  for (uint32_t i = 0; i + 1 < kImages; ++i) {
    const Vector3d step = placed.centres.row(i + 1) - placed.centres.row(i);
    const Vector3d truth = corner.TrueInEnu(i + 1) - corner.TrueInEnu(i);
    worst = std::max(worst, (step - truth).head<2>().norm());
  }
  return worst;
}

TEST(PlaceInEnu, DoesNotMoveNeighboursByWhatPositionsScatter) {
  Corner corner(kTurn);
  for (ClusterImage& image : corner.problem.images) image.prior.horizontal_sigma_m = 0.5;
  const auto believed = corner.Placed(1.0);
  const auto doubted = corner.Placed(4.0);
  ASSERT_TRUE(believed.has_value() && doubted.has_value());
  EXPECT_GE(doubted->scatter, 4.0);
  EXPECT_LT(WorstStep(corner, *doubted), 0.5 * WorstStep(corner, *believed));
}

TEST(PlaceInEnu, FindsTheTurnWhereNobodyKnowsWhatIsUp) {
  Corner corner(kTurn);
  Random random(9);
  for (Eigen::Quaterniond& cam : corner.cams_from_world)
    cam = RotationFromVector(2.0 * Vector3d(random.Normal(), random.Normal(), random.Normal()));
  ASSERT_FALSE(UprightFromWorld(corner.cams_from_world).has_value());
  const auto placed = corner.Placed();
  ASSERT_TRUE(placed.has_value());
  EXPECT_LT(WorstInPlan(corner, *placed), 1.5);
}

TEST(PlaceInEnu, DoesNothingWherePositionsDoNotSpread) {
  Corner corner(kTurn);
  for (ClusterImage& image : corner.problem.images) image.prior.horizontal_sigma_m = 20.0;
  EXPECT_FALSE(corner.Placed().has_value());
}

TEST(UprightFromWorld, MakesUpTheThirdAxis) {
  const std::vector<Eigen::Quaterniond> cams(4, kTurn.conjugate());
  const auto upright = UprightFromWorld(cams);
  ASSERT_TRUE(upright.has_value());
  EXPECT_LT((*upright * (kTurn * -Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace orbweave
