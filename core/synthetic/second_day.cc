// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/second_day.h"

#include <algorithm>

#include "core/base/random.h"
#include "core/synthetic/append_car.h"

namespace orbweave {

StreetWorld SecondDayOf(const StreetWorld& first, uint64_t seed) {
  Random random(seed);
  StreetWorld world = first;
  std::erase_if(world.solids, [](const Solid& solid) {
    return solid.kind == SolidKind::kCarBody || solid.kind == SolidKind::kCarCabin;
  });
  for (Solid& solid : world.solids) solid.look.wares = 7919;
  const double length_m = world.layout.axis.length_m();
  for (double s = random.Uniform(0.0, 6.0); s < length_m - 3.0; s += random.Uniform(5.5, 11.0)) {
    const double left_m = StreetProfile::kParkedCars_m + random.Uniform(-0.15, 0.1);
    if (random.Uniform() < 0.55 && IsStraightAt(world.layout, s)) {
      AppendCar(world.layout.axis.At(s), left_m, random, world.solids);
    }
  }
  world.grid = SolidGrid(world.solids);
  world.light.to_sun = Eigen::Vector3d(-0.75, 0.30, 0.50).normalized();
  world.light.clouds = 1;
  return world;
}

}  // namespace orbweave
