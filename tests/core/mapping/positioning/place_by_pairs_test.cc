// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_by_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/mapping/broken_street.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

PairPlacement Placed(const StreetFixture& street, std::vector<uint8_t> available = {}) {
  if (available.empty()) available.assign(street.graph.NumImages(), 1);
  const auto placement = PlaceByPairs(street.world.problem, street.graph, available, {}, {});
  EXPECT_TRUE(placement.ok()) << placement.status();
  return placement.ok() ? *placement : PairPlacement{};
}

ModelError ErrorOfPlacement(const StreetFixture& street, const PairPlacement& placement) {
  Reconstruction model;
  for (size_t i = 0; i < placement.images.size(); ++i) {
    model.images[ImageId(placement.images[i])] = {.cam_from_world = placement.cams_from_world[i]};
  }
  return ErrorOf(model, street.world.cams_from_world);
}

TEST(PlaceByPairs, PlacesTheImagesOfAStraightStreet) {
  const StreetFixture street({.centres = StraightWalk(30, 3.0), .random_rotations = true});
  const PairPlacement placement = Placed(street);
  ASSERT_EQ(placement.images, FirstImages(30));
  const ModelError error = ErrorOfPlacement(street, placement);
  EXPECT_LT(error.position_rmse, 0.3);  // of 87 metres
  EXPECT_LT(error.max_rotation_rad, 5e-3);
}

TEST(PlaceByPairs, ClosesALoop) {
  RayStreetOptions options{.centres = RoundWalk(24, 12.0)};
  options.window = 23;
  const StreetFixture street(options);
  const PairPlacement placement = Placed(street);
  ASSERT_EQ(placement.images.size(), 24U);
  EXPECT_LT(ErrorOfPlacement(street, placement).position_rmse, 0.05);
}

TEST(PlaceByPairs, IsNotLedAstrayByPairsWithAWrongGeometry) {
  StreetFixture street({.centres = StraightWalk(30, 3.0)});
  Random random(4);
  for (TwoViewGeometry& pair : street.world.problem.pairs) {
    if (random.Uniform() < 0.15) {
      pair.b_from_a.rotation = street_internal::RandomRotation(random);
    }
  }
  const PairPlacement placement = Placed(street);
  ASSERT_EQ(placement.images.size(), 30U);
  const ModelError error = ErrorOfPlacement(street, placement);
  EXPECT_LT(error.position_rmse, 0.3);
  EXPECT_LT(error.max_rotation_rad, 5e-3);
}

TEST(PlaceByPairs, LeavesImagesThatAreNotAvailable) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  std::vector<uint8_t> available(12, 1);
  available[0] = available[11] = 0;
  const PairPlacement placement = Placed(street, available);
  ASSERT_EQ(placement.images.size(), 10U);
  EXPECT_EQ(placement.images.front(), 1U);
}

TEST(PlaceByPairs, PlacesTheLargestOfTwoParts) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(5, 3.0);
  for (const Eigen::Vector3d& centre : StraightWalk(8, 3.0)) {
    centres.push_back(centre + Eigen::Vector3d(500.0, 0.0, 0.0));
  }
  const PairPlacement placement = Placed(StreetFixture({.centres = centres}));
  ASSERT_EQ(placement.images.size(), 8U);
  EXPECT_EQ(placement.images.front(), 5U);
}

TEST(PlaceByPairs, PlacesNothingWhereTheCameraNeverMoves) {
  const StreetFixture street({.centres = StraightWalk(6, 0.0), .points_per_metre = 80});
  ASSERT_FALSE(street.graph.pairs.empty());
  EXPECT_TRUE(Placed(street).images.empty());
}

/// Largest distance from where images truly are.
double WorstInEnu(const BrokenStreet& street, const PairPlacement& placement) {
  double worst = 0.0;
  for (size_t i = 0; i < placement.images.size(); ++i) {
    worst = std::max(
        worst,
        (placement.cams_from_world[i].Centre() - street.PlaceInEnu(placement.images[i])).norm());
  }
  return worst;
}

PairPlacement PlacedBroken(BrokenStreet& street) {
  street.DetachPairsBetween();
  const std::vector<uint8_t> available(BrokenStreet::kImages, 1);
  const auto placement = PlaceByPairs(street.World().problem, street.Graph(), available, {}, {});
  EXPECT_TRUE(placement.ok()) << placement.status();
  return placement.ok() ? *placement : PairPlacement{};
}

TEST(PlaceByPairs, GoesOnByGnssWhereNoRayCarriesTheScale) {
  for (const bool random_rotations : {false, true}) {
    BrokenStreet street({.random_rotations = random_rotations});
    const PairPlacement placement = PlacedBroken(street);
    ASSERT_EQ(placement.images.size(), BrokenStreet::kImages);
    EXPECT_TRUE(placement.position_factor.has_value());
    EXPECT_LT(WorstInEnu(street, placement), 3.0);
  }
}

TEST(PlaceByPairs, StopsWithoutGnssWhereNoRayCarriesTheScale) {
  BrokenStreet street({.has_gnss = false});
  const PairPlacement placement = PlacedBroken(street);
  EXPECT_EQ(placement.images.size(), BrokenStreet::kFirstOfSecond);
  EXPECT_FALSE(placement.position_factor.has_value());
}

TEST(PlaceByPairs, IsNotLedAstrayByAFewPositions) {
  BrokenStreet street({});
  for (const uint32_t image : {3U, 14U, 20U})
    *street.World().problem.images[image].prior.position_in_enu += Eigen::Vector3d(60, -80, 10);
  const PairPlacement placement = PlacedBroken(street);
  ASSERT_EQ(placement.images.size(), BrokenStreet::kImages);
  EXPECT_LT(WorstInEnu(street, placement), 4.0);
}

}  // namespace
}  // namespace orbweave
