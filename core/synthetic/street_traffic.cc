// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_traffic.h"

#include <cmath>
#include <numbers>

#include "core/synthetic/append_car.h"
#include "core/synthetic/upright_solid.h"

namespace orbweave {
namespace {

/// Legs, trunk and head; 1.6 to 1.9 m tall.
void AppendPerson(const Eigen::Vector2d& place, Random& random, std::vector<Solid>& people) {
  const double heading = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d left(-along.y(), along.x());
  const double size = random.Uniform(0.92, 1.08);
  const auto append = [&](const Eigen::Vector3d& extent_m, double base_m) {
    people.push_back(
        UprightSolid(SolidKind::kPerson, place, along, size * extent_m, size * base_m, random));
  };
  const double stride_m = random.Uniform(0.05, 0.22);
  for (const double side : {-1.0, 1.0}) {  // legs
    const Eigen::Vector2d foot = place + side * (stride_m * along + 0.09 * left);
    people.push_back(UprightSolid(
        SolidKind::kPerson, foot, along, size * Eigen::Vector3d(0.24, 0.19, 1.1), -0.1, random));
  }
  people.back().seed = (people.end() - 2)->seed;
  append({0.30, 0.50, 0.80}, 0.75);
  append({0.21, 0.18, 0.26}, 1.47);
}

/// Distance along the street between 3 and 25 m, ahead or behind.
double NearBy(Random& random) {
  const double distance_m = random.Uniform(3.0, 25.0);
  return random.Uniform() < 0.5 ? distance_m : -distance_m;
}

/// Between the facades and the kerbs; one of seven on the road.
double LeftOfWalker(Random& random) {
  using Profile = StreetProfile;
  const double kind = random.Uniform();
  if (kind < 0.43) return random.Uniform(Profile::kInnerFacade_m + 0.5, Profile::kInnerKerb_m);
  if (kind < 0.86) return random.Uniform(Profile::kOuterKerb_m, Profile::kOuterFacade_m - 0.5);
  return random.Uniform(Profile::kInnerKerb_m, Profile::kParkedCars_m - 1.0);
}

}  // namespace

std::vector<Solid> MakePassers(const StreetLayout& layout,
                               double station_m,
                               const StreetHardships& hardships,
                               Random& random) {
  std::vector<Solid> passers;
  for (int i = 0; i < hardships.pedestrians; ++i) {
    const PathPlace place = layout.axis.At(station_m + NearBy(random));
    AppendPerson(place.position + LeftOfWalker(random) * place.Left(), random, passers);
  }
  for (int i = 0; i < hardships.vehicles; ++i) {
    // Slots of 12 m, so that vehicles do not run into each other.
    const double side = i % 4 < 2 ? 1.0 : -1.0;
    const double ahead_m = side * (9.0 + 12.0 * (i / 4) + random.Uniform(0.0, 1.5));
    const PathPlace place = layout.axis.At(station_m + ahead_m);
    const double left_m = i % 2 == 0 ? StreetProfile::kOncomingLane_m + 0.2 : 0.0;
    if (random.Uniform() < 0.5) {
      AppendCar(place, left_m, random, passers);
      continue;
    }
    const Eigen::Vector3d size_m(random.Uniform(4.8, 9.5), 2.1, random.Uniform(2.2, 3.0));
    const Eigen::Vector2d middle = place.position + left_m * place.Left();
    passers.push_back(UprightSolid(SolidKind::kBus, middle, place.direction, size_m, 0.25, random));
  }
  return passers;
}

Solid MakeBusAhead(const StreetLayout& layout, double station_m) {
  constexpr double kGap_m = 5.0;
  const Eigen::Vector3d size_m(11.5, 2.5, 3.0);
  const PathPlace rear = layout.axis.At(station_m + kGap_m);
  Random livery(11);
  return UprightSolid(SolidKind::kBus,
                      rear.position + size_m.x() / 2.0 * rear.direction,
                      rear.direction,
                      size_m,
                      0.25,
                      livery);
}

}  // namespace orbweave
