// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_by_positions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/growth/start_globally.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kImages = 20;

/// Two legs of a street at a right angle, 8 m a step; positions of 1.5 m in east, north and up.
struct Corner {
  explicit Corner(bool random_rotations = false)
      : street({.centres = Centres(),
                .points_per_metre = 2,
                .reach_m = 30.0,
                .window = 4,
                .random_rotations = random_rotations}) {
    Random random(3);
    for (uint32_t i = 0; i < kImages; ++i) {
      const Vector3d noise(random.Normal(), random.Normal(), random.Normal());
      Prior(i).position_in_enu = TrueInEnu(i) + 1.5 * noise;
      Prior(i).horizontal_sigma_m = Prior(i).vertical_sigma_m = 1.5;
      street.world.problem.images[i].rank_in_drive = i;
    }
  }

  static std::vector<Vector3d> Centres() {
    std::vector<Vector3d> centres;
    for (uint32_t i = 0; i < kImages; ++i)
      centres.emplace_back(8.0 * std::min(i, 10U), 0.0, i > 10 ? 8.0 * (i - 10.0) : 0.0);
    return centres;
  }
  [[nodiscard]] PosePrior& Prior(uint32_t image) {
    return street.world.problem.images[image].prior;
  }
  /// x east, z north, y down.
  [[nodiscard]] Vector3d TrueInEnu(uint32_t image) const {
    const Vector3d C = street.world.cams_from_world[image].Centre();
    return {C.x() + 30.0, C.z() - 12.0, -C.y() + 4.0};
  }
  [[nodiscard]] PairPlacement Placed() const {
    const std::vector<uint8_t> available(kImages, 1);
    const auto placed = PlaceByPositions(street.world.problem, street.graph, available, {}, {});
    EXPECT_TRUE(placed.ok()) << placed.status();
    return placed.ok() ? *placed : PairPlacement{};
  }
  /// The worst step to the next image, horizontally.
  template <typename CentreOf>
  [[nodiscard]] double WorstStepOf(const CentreOf& centre_of) const {
    double worst = 0.0;
    for (uint32_t i = 0; i + 1 < kImages; ++i) {
      const Vector3d step = centre_of(i + 1) - centre_of(i);
      worst = std::max(worst, (step - TrueInEnu(i + 1) + TrueInEnu(i)).head<2>().norm());
    }
    return worst;
  }
  [[nodiscard]] double WorstStep(const PairPlacement& placed) const {
    return WorstStepOf([&](uint32_t image) { return placed.cams_from_world[image].Centre(); });
  }
  [[nodiscard]] double WorstStepOfPositions() const {
    return WorstStepOf(
        [&](uint32_t image) { return *street.world.problem.images[image].prior.position_in_enu; });
  }

  StreetFixture street;
};

TEST(PlaceByPositions, HasStepsBetterThanPositions) {
  const Corner corner;
  const PairPlacement placed = corner.Placed();
  ASSERT_EQ(placed.images, FirstImages(kImages));
  EXPECT_LT(corner.WorstStep(placed), 0.5 * corner.WorstStepOfPositions());
  EXPECT_TRUE(placed.position_factor.has_value());
}

TEST(PlaceByPositions, TakesPanoramasTurnedAnyhow) {
  const Corner corner(true);
  const PairPlacement placed = corner.Placed();
  ASSERT_EQ(placed.images, FirstImages(kImages));
  EXPECT_LT(corner.WorstStep(placed), 0.5 * corner.WorstStepOfPositions());
}

TEST(PlaceByPositions, BridgesPositionsThatAreMissingOrWrong) {
  Corner corner;
  corner.Prior(3).position_in_enu.reset();
  *corner.Prior(6).position_in_enu += Vector3d(40.0, 20.0, 0.0);
  *corner.Prior(15).position_in_enu += Vector3d(0.0, -30.0, 0.0);
  const PairPlacement placed = corner.Placed();
  ASSERT_EQ(placed.images, FirstImages(kImages));
  EXPECT_LT(corner.WorstStep(placed), 4.0);  // half a step
}

TEST(PlaceByPositions, DoesNotAskPairsHowLongStepsAre) {
  Corner corner;
  const auto before = corner.Placed();
  // Rays of the next house: depths, and so lengths, are wrong; directions are not.
  for (TwoViewGeometry& pair : corner.street.world.problem.pairs) pair.median_angle_rad *= 0.5;
  const auto after = corner.Placed();
  EXPECT_NEAR(corner.WorstStep(after), corner.WorstStep(before), 1e-9);
}

TEST(PlaceByPositions, LearnsThatDrivesHaveAnotherOriginOfHeights) {
  Corner corner;
  for (uint32_t i = 8; i < kImages; ++i) {
    corner.street.world.problem.images[i].drive = 1;
    corner.Prior(i).position_in_enu->z() += 47.0;
  }
  const PairPlacement placed = corner.Placed();
  ASSERT_EQ(placed.images, FirstImages(kImages));
  EXPECT_NEAR(placed.height_offset_m[0], 0.0, 1e-9);
  EXPECT_NEAR(placed.height_offset_m[8], 47.0, 2.0);
  for (uint32_t i = 0; i < kImages; ++i)
    EXPECT_NEAR(placed.cams_from_world[i].Centre().z(), corner.TrueInEnu(i).z(), 2.0);
}

TEST(PlaceByPositions, SaysNothingWithoutPositions) {
  Corner corner;
  for (uint32_t i = 9; i < kImages; ++i) corner.Prior(i).position_in_enu.reset();
  EXPECT_TRUE(corner.Placed().images.empty());
}

TEST(StartOnPositions, HoldsAllImages) {
  const Corner corner;
  MappingState state = corner.street.StateWith({});
  const std::vector<uint8_t> available(kImages, 1);
  const auto started = StartOnPositions(state, available, {}, {});
  ASSERT_TRUE(started.ok() && *started);
  EXPECT_EQ(state.Registered().size(), kImages);
  EXPECT_TRUE(state.IsInEnu());
  for (uint32_t i = 0; i + 1 < kImages; ++i) {
    const double step_m = (state.Centre(i + 1) - state.Centre(i)).norm();
    EXPECT_NEAR(step_m, 8.0, 0.5) << "image " << i;
  }
}

}  // namespace
}  // namespace orbweave
