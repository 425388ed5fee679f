// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/append_car.h"

#include "core/synthetic/upright_solid.h"

namespace orbweave {

void AppendCar(const PathPlace& place, double left_m, Random& random, std::vector<Solid>& solids) {
  const Eigen::Vector2d middle = place.position + left_m * place.Left();
  const double length_m = random.Uniform(3.9, 4.7);
  const double height_m = random.Uniform(0.65, 0.85);
  const auto paint = static_cast<uint32_t>(random.Next() >> 32);
  solids.push_back(UprightSolid(
      SolidKind::kCarBody, middle, place.direction, {length_m, 1.78, height_m}, 0.2, random));
  solids.push_back(UprightSolid(SolidKind::kCarCabin,
                                middle - 0.3 * place.direction,
                                place.direction,
                                {0.55 * length_m, 1.6, 0.6},
                                0.2 + height_m,
                                random));
  for (Solid* part : {&solids.back() - 1, &solids.back()}) part->seed = paint;
}

bool IsStraightAt(const StreetLayout& layout, double station_m) {
  const auto there = layout.axis.At(station_m + 4.0).direction;
  return layout.axis.At(station_m - 4.0).direction.dot(there) > 0.999;
}

}  // namespace orbweave
