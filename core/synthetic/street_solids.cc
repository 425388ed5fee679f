// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_solids.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

uint32_t NewSeed(Random& random) { return static_cast<uint32_t>(random.Next() >> 32); }

/// A solid that stands on the ground at `base_m` above it.
Solid Upright(SolidKind kind,
              const Eigen::Vector2d& middle,
              const Eigen::Vector2d& along,
              const Eigen::Vector3d& size_m,
              double base_m,
              Random& random) {
  return {kind,
          {middle.x(), middle.y(), kStreetGround_m + base_m + size_m.z() / 2.0},
          size_m / 2.0,
          along,
          NewSeed(random)};
}

/// A row of houses whose front line runs from `start` in direction `along`; the houses lie on the
/// left of it.
struct HouseRow {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double length_m = 0.0;
  double depth_m = 0.0;
  double gap_share = 0.0;  // of houses followed by an alley
};

/// Air conditioners, signs and balconies on a front wall, so that facades are no mere planes.
void AppendFixtures(const Eigen::Vector2d& front_start,
                    const Eigen::Vector2d& along,
                    double width_m,
                    double height_m,
                    Random& random,
                    std::vector<Solid>& solids) {
  const Eigen::Vector2d outwards(along.y(), -along.x());
  const int count = static_cast<int>(width_m * height_m / 18.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size(
        random.Uniform(0.5, 1.4), random.Uniform(0.3, 0.7), random.Uniform(0.3, 0.7));
    const double place_m = random.Uniform(0.8, std::max(0.9, width_m - 0.8));
    const double base_m = random.Uniform(3.4, std::max(3.5, height_m - 1.0));
    solids.push_back(Upright(SolidKind::kFixture,
                             front_start + place_m * along + size.y() / 2.0 * outwards,
                             along,
                             size,
                             base_m,
                             random));
  }
}

void AppendHouses(const HouseRow& row, Random& random, std::vector<Solid>& solids) {
  const Eigen::Vector2d inwards(-row.along.y(), row.along.x());
  for (double place_m = 0.0; place_m < row.length_m - 0.5;) {
    double width_m = random.Uniform(6.0, 12.0);
    if (row.length_m - place_m - width_m < 4.0) width_m = row.length_m - place_m;
    const double setback_m = random.Uniform(0.0, 0.6);
    const double height_m = random.Uniform(7.0, 17.0);
    const Eigen::Vector2d front = row.start + place_m * row.along + setback_m * inwards;
    const double depth_m = row.depth_m - setback_m;
    solids.push_back(Upright(SolidKind::kBuilding,
                             front + width_m / 2.0 * row.along + depth_m / 2.0 * inwards,
                             row.along,
                             {width_m, depth_m, height_m},
                             0.0,
                             random));
    AppendFixtures(front, row.along, width_m, height_m, random, solids);
    place_m += width_m;
    if (random.Uniform() < row.gap_share) place_m += random.Uniform(1.0, 2.5);
  }
}

/// The block inside the loop: rows on all four sides, as deep as half of it or 9 m.
void AppendBlock(const Eigen::Vector2d& half, Random& random, std::vector<Solid>& solids) {
  const double depth_m = std::min(9.0, half.y());
  const double a = half.x();
  const double b = half.y();
  const double side_m = 2.0 * (b - depth_m);
  AppendHouses({{-a, -b}, {1.0, 0.0}, 2.0 * a, depth_m, 0.0}, random, solids);
  AppendHouses({{a, b}, {-1.0, 0.0}, 2.0 * a, depth_m, 0.0}, random, solids);
  AppendHouses({{a, -b + depth_m}, {0.0, 1.0}, side_m, depth_m, 0.1}, random, solids);
  AppendHouses({{-a, b - depth_m}, {0.0, -1.0}, side_m, depth_m, 0.1}, random, solids);
}

/// The houses across the street, with alleys between some of them.
void AppendRing(const Eigen::Vector2d& half, Random& random, std::vector<Solid>& solids) {
  constexpr double kDepth_m = 10.0;
  const double a = half.x();
  const double b = half.y();
  const double long_m = 2.0 * (a + kDepth_m);
  AppendHouses({{a + kDepth_m, -b}, {-1.0, 0.0}, long_m, kDepth_m, 0.3}, random, solids);
  AppendHouses({{-a - kDepth_m, b}, {1.0, 0.0}, long_m, kDepth_m, 0.3}, random, solids);
  AppendHouses({{-a, -b}, {0.0, 1.0}, 2.0 * b, kDepth_m, 0.3}, random, solids);
  AppendHouses({{a, b}, {0.0, -1.0}, 2.0 * b, kDepth_m, 0.3}, random, solids);
}

/// Body and cabin of a car.
void AppendCar(const PathPlace& place, double left_m, Random& random, std::vector<Solid>& solids) {
  const Eigen::Vector2d middle = place.position + left_m * place.Left();
  const double length_m = random.Uniform(3.9, 4.7);
  const double height_m = random.Uniform(0.65, 0.85);
  const uint32_t paint = NewSeed(random);
  solids.push_back(Upright(
      SolidKind::kCarBody, middle, place.direction, {length_m, 1.78, height_m}, 0.2, random));
  solids.push_back(Upright(SolidKind::kCarCabin,
                           middle - 0.3 * place.direction,
                           place.direction,
                           {0.55 * length_m, 1.6, 0.6},
                           0.2 + height_m,
                           random));
  for (Solid* part : {&solids.back() - 1, &solids.back()}) part->seed = paint;
}

void AppendTree(const Eigen::Vector2d& place, Random& random, std::vector<Solid>& solids) {
  const Eigen::Vector2d along(1.0, 0.0);
  const double trunk_m = random.Uniform(2.6, 3.4);
  solids.push_back(
      Upright(SolidKind::kPole, place, along, {0.25, 0.25, trunk_m + 0.4}, 0.0, random));
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector2d shift(random.Uniform(-0.9, 0.9), random.Uniform(-0.9, 0.9));
    const double size_m = random.Uniform(0.8, 1.6);
    solids.push_back(Upright(SolidKind::kCrown,
                             place + shift,
                             along,
                             {size_m, size_m, 0.9 * size_m},
                             trunk_m + random.Uniform(-0.4, 1.3),
                             random));
  }
}

bool IsStraight(const StreetLayout& layout, double station_m) {
  const auto there = layout.axis.At(station_m + 4.0).direction;
  return layout.axis.At(station_m - 4.0).direction.dot(there) > 0.999;
}

/// Both kerbs: cars, trees, lamp posts and hedges at random distances.
void AppendKerbside(const StreetLayout& layout, Random& random, std::vector<Solid>& solids) {
  using Profile = StreetProfile;
  for (double s = 0.0; s < layout.axis.length_m(); s += random.Uniform(5.5, 9.0)) {
    const PathPlace place = layout.axis.At(s);
    const double kind = random.Uniform();
    if (kind < 0.6 && IsStraight(layout, s)) {
      AppendCar(place, Profile::kParkedCars_m + random.Uniform(-0.15, 0.1), random, solids);
    } else if (kind < 0.85) {
      AppendTree(place.position + (Profile::kOuterKerb_m + 1.0) * place.Left(), random, solids);
    }
  }
  for (double s = 3.0; s < layout.axis.length_m(); s += random.Uniform(7.0, 14.0)) {
    const PathPlace place = layout.axis.At(s);
    const Eigen::Vector2d kerb = place.position + (Profile::kInnerKerb_m - 0.4) * place.Left();
    if (random.Uniform() < 0.5) {
      const double height_m = random.Uniform(2.5, 6.0);
      solids.push_back(
          Upright(SolidKind::kPole, kerb, place.direction, {0.16, 0.16, height_m}, 0.0, random));
    } else {
      const Eigen::Vector3d size(random.Uniform(1.0, 2.5), 0.5, random.Uniform(0.5, 1.1));
      solids.push_back(Upright(
          SolidKind::kHedge, kerb - 0.3 * place.Left(), place.direction, size, 0.0, random));
    }
  }
}

}  // namespace

std::vector<Solid> MakeStreetSolids(const StreetLayout& layout, uint64_t seed) {
  Random random(seed);
  std::vector<Solid> solids;
  AppendBlock((layout.half_m.array() + StreetProfile::kInnerFacade_m).matrix(), random, solids);
  AppendRing((layout.half_m.array() + StreetProfile::kOuterFacade_m).matrix(), random, solids);
  AppendKerbside(layout, random, solids);
  return solids;
}

std::vector<Solid> MakeMovingCars(const StreetLayout& layout, double station_m, Random& random) {
  std::vector<Solid> cars;
  for (const double side : {1.0, -1.0}) {
    if (random.Uniform() < 0.7) {  // oncoming
      const double there_m = station_m + side * random.Uniform(5.0, 30.0);
      AppendCar(layout.axis.At(there_m), StreetProfile::kOncomingLane_m, random, cars);
    }
    if (random.Uniform() < 0.4) {  // in front or behind
      const double there_m = station_m + side * random.Uniform(10.0, 25.0);
      AppendCar(layout.axis.At(there_m), 0.0, random, cars);
    }
  }
  return cars;
}

}  // namespace orbweave
