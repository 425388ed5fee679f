// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_on_gnss.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// A straight street whose cameras have GNSS of one metre.
class Street {
 public:
  explicit Street(uint32_t count, bool random_rotations = false)
      : fixture_({.centres = StraightWalk(static_cast<int>(count), 8.0),
                  .points_per_metre = 2,
                  .random_rotations = random_rotations}) {
    Random random(3);
    for (ImageSlot image = 0; image < count; ++image) {
      const Vector3d& C = fixture_.world.cams_from_world[image].Centre();
      PosePrior& prior = fixture_.world.problem.images[image].prior;
      prior.position_in_enu = Truth() * C + Vector3d(random.Normal(), random.Normal(), 0.0);
      prior.horizontal_sigma_m = 1.0;
    }
  }

  /// Upright: the world's y is down.
  static Sim3 Truth() {
    const Eigen::Quaterniond upright(Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()));
    const Eigen::Quaterniond heading(Eigen::AngleAxisd(0.6, Vector3d::UnitZ()));
    return {2.0, heading * upright, {100.0, -50.0, 12.0}};
  }

  PosePrior& Prior(ImageSlot image) { return fixture_.world.problem.images[image].prior; }

  [[nodiscard]] std::optional<Sim3> Place() const {
    const auto count = static_cast<uint32_t>(fixture_.world.problem.images.size());
    const MappingState state = fixture_.StateWith(FirstImages(count));
    return PlaceOnGnss(state, FirstImages(count));
  }

 private:
  StreetFixture fixture_;
};

void ExpectTruth(const std::optional<Sim3>& placed) {
  ASSERT_TRUE(placed.has_value());
  EXPECT_NEAR(placed->scale, 2.0, 0.05);
  EXPECT_LT(RotationAngle(placed->rotation * Street::Truth().rotation.conjugate()), 0.03);
  const Vector3d ahead(200.0, 0.0, 0.0);
  EXPECT_LT((*placed * ahead - Street::Truth() * ahead).norm(), 8.0);
}

TEST(PlaceOnGnss, PlacesAStraightStreetUpright) { ExpectTruth(Street(12).Place()); }

TEST(PlaceOnGnss, IsNotLedAstrayByAFifthOfWrongPositions) {
  Street street(15);
  for (const ImageSlot image : {2U, 7U, 11U})
    *street.Prior(image).position_in_enu += Vector3d(40.0, 60.0, 0.0);
  ExpectTruth(street.Place());
}

TEST(PlaceOnGnss, SaysNothingWhereGnssDoes) {
  EXPECT_FALSE(Street(3).Place().has_value());
  Street street(12);
  for (ImageSlot image = 0; image < 9; ++image) street.Prior(image).position_in_enu.reset();
  EXPECT_FALSE(street.Place().has_value());
  Street vague(12);
  for (ImageSlot image = 0; image < 12; ++image) vague.Prior(image).horizontal_sigma_m = 80.0;
  EXPECT_FALSE(vague.Place().has_value());
}

TEST(PlaceOnGnss, SaysNothingOfPositionsThatDoNotFit) {
  Street street(12);
  for (ImageSlot image = 0; image < 12; image += 2)
    *street.Prior(image).position_in_enu += Vector3d(-30.0, 50.0, 0.0);
  EXPECT_FALSE(street.Place().has_value());
}

TEST(PlaceOnGnss, SaysNothingWherePanoramasAreTurnedAnyhow) {
  EXPECT_FALSE(Street(12, true).Place().has_value());
}

TEST(ImagesNear, AreThoseNearestAscending) {
  const StreetFixture street({.centres = StraightWalk(50, 2.0), .points_per_metre = 1});
  const MappingState state = street.StateWith(FirstImages(50));
  const std::vector<ImageSlot> near = ImagesNear(state, Vector3d(98.0, 0.0, 0.0));
  ASSERT_EQ(near.size(), 30U);
  EXPECT_EQ(near.front(), 20U);
  EXPECT_EQ(near.back(), 49U);
}

}  // namespace
}  // namespace orbweave
