// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/second_day.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/synthetic/make_street.h"
#include "core/synthetic/street.h"

namespace orbweave {
namespace {

bool IsCar(const Solid& solid) {
  return solid.kind == SolidKind::kCarBody || solid.kind == SolidKind::kCarCabin;
}

std::vector<Solid> WithoutCars(std::vector<Solid> solids) {
  std::erase_if(solids, IsCar);
  return solids;
}

TEST(SecondDay, DiffersInLightCarsAndWaresNotInGeometry) {
  const StreetWorld first = MakeStreetWorld(150.0, 3, {.plain_share = 0.5});
  const StreetWorld second = SecondDayOf(first, 4);
  EXPECT_GT(std::acos(first.light.to_sun.dot(second.light.to_sun)), 0.5);
  EXPECT_NEAR(second.light.to_sun.norm(), 1.0, 1e-12);
  const std::vector<Solid> stayed = WithoutCars(first.solids);
  const std::vector<Solid> found = WithoutCars(second.solids);
  ASSERT_EQ(stayed.size(), found.size());
  for (size_t k = 0; k < stayed.size(); ++k) {
    EXPECT_EQ(stayed[k].centre, found[k].centre);
    EXPECT_EQ(stayed[k].half, found[k].half);
    EXPECT_EQ(stayed[k].seed, found[k].seed);
    EXPECT_NE(stayed[k].look.wares, found[k].look.wares);
  }
  size_t same_place = 0;
  size_t cars = 0;
  for (const Solid& car : second.solids) {
    if (!IsCar(car)) continue;
    ++cars;
    for (const Solid& other : first.solids)
      same_place += IsCar(other) && (other.centre - car.centre).norm() < 0.05;
  }
  EXPECT_GT(cars, 10U);
  EXPECT_EQ(same_place, 0U);
}

TEST(SecondDay, TakesTheShareOfPanoramasAskedForInStretches) {
  const Street street = MakeStreet({.panoramas = 200, .hardships = {.second_day_share = 0.3}});
  int of_second = 0;
  int changes = 0;
  for (size_t i = 0; i < 200; ++i) {
    of_second += street.on_second_day[i];
    if (i > 0) changes += street.on_second_day[i] != street.on_second_day[i - 1];
    EXPECT_EQ(&street.WorldOf(i), street.on_second_day[i] ? &*street.second_day : &street.world);
  }
  EXPECT_EQ(of_second, 60);
  EXPECT_EQ(changes, 20);
  const Street one_day = MakeStreet({.panoramas = 200});
  for (size_t i = 0; i < 200; ++i) EXPECT_FALSE(one_day.on_second_day[i]);
  EXPECT_FALSE(one_day.second_day.has_value());
}

}  // namespace
}  // namespace orbweave
