// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_solids.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/synthetic/append_car.h"
#include "core/synthetic/noise.h"
#include "core/synthetic/upright_solid.h"

namespace orbweave {
namespace {

/// A row of houses whose front line runs from `start` in direction `along`; the houses lie on the
/// left of it.
struct HouseRow {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double length_m = 0.0;
  double depth_m = 0.0;
  double gap_share = 0.0;  // of houses followed by an alley
};

/// What one house is built by: another of the same plan is the same house.
struct HousePlan {
  double width_m = 0.0;
  double setback_m = 0.0;
  double height_m = 0.0;
  uint32_t seed = 0;
  Random fixtures{0};
};

/// Air conditioners, signs and balconies on a front wall, so that facades are no mere planes; a
/// plain one keeps every third.
void AppendFixtures(const Eigen::Vector2d& front_start,
                    const Eigen::Vector2d& along,
                    double width_m,
                    double height_m,
                    bool plain,
                    Random& random,
                    std::vector<Solid>& solids) {
  const Eigen::Vector2d outwards(along.y(), -along.x());
  const int count = static_cast<int>(width_m * height_m / 18.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size(
        random.Uniform(0.5, 1.4), random.Uniform(0.3, 0.7), random.Uniform(0.3, 0.7));
    const double place_m = random.Uniform(0.8, std::max(0.9, width_m - 0.8));
    const double base_m = random.Uniform(3.4, std::max(3.5, height_m - 1.0));
    solids.push_back(UprightSolid(SolidKind::kFixture,
                                  front_start + place_m * along + size.y() / 2.0 * outwards,
                                  along,
                                  size,
                                  base_m,
                                  random));
    if (plain && i % 3 != 0) solids.pop_back();
  }
}

void AppendHouses(const HouseRow& row,
                  const StreetHardships& hardships,
                  Random& random,
                  std::vector<Solid>& solids) {
  const Eigen::Vector2d inwards(-row.along.y(), row.along.x());
  std::optional<HousePlan> before;
  for (double place_m = 0.0; place_m < row.length_m - 0.5;) {
    HousePlan plan;
    plan.width_m = random.Uniform(6.0, 12.0);
    if (row.length_m - place_m - plan.width_m < 4.0) plan.width_m = row.length_m - place_m;
    plan.setback_m = random.Uniform(0.0, 0.6);
    plan.height_m = random.Uniform(7.0, 17.0);
    plan.seed = static_cast<uint32_t>(random.Next() >> 32);
    plan.fixtures = random;
    const bool fits = before && row.length_m - place_m - before->width_m >= 4.0;
    const bool repeats = fits && UniformOf(12, 0, plan.seed) < hardships.repeat_share;
    if (repeats) plan = *before;
    before = plan;
    const bool plain = UniformOf(11, 0, plan.seed) < hardships.plain_share;
    const Eigen::Vector2d front = row.start + place_m * row.along + plan.setback_m * inwards;
    const double depth_m = row.depth_m - plan.setback_m;
    Random unused(0);
    solids.push_back(UprightSolid(SolidKind::kBuilding,
                                  front + plan.width_m / 2.0 * row.along + depth_m / 2.0 * inwards,
                                  row.along,
                                  {plan.width_m, depth_m, plan.height_m},
                                  0.0,
                                  unused));
    solids.back().seed = plan.seed;
    solids.back().look = {.plain = plain, .equal_windows = hardships.equal_windows};
    Random& fixtures = repeats ? plan.fixtures : random;
    AppendFixtures(front, row.along, plan.width_m, plan.height_m, plain, fixtures, solids);
    place_m += plan.width_m;
    if (random.Uniform() < row.gap_share) place_m += random.Uniform(1.0, 2.5);
  }
}

/// The block inside the loop: rows on all four sides, as deep as half of it or 9 m.
void AppendBlock(const Eigen::Vector2d& half,
                 const StreetHardships& hardships,
                 Random& random,
                 std::vector<Solid>& solids) {
  const double depth_m = std::min(9.0, half.y());
  const double a = half.x();
  const double b = half.y();
  const double side_m = 2.0 * (b - depth_m);
  AppendHouses({{-a, -b}, {1.0, 0.0}, 2.0 * a, depth_m, 0.0}, hardships, random, solids);
  AppendHouses({{a, b}, {-1.0, 0.0}, 2.0 * a, depth_m, 0.0}, hardships, random, solids);
  AppendHouses({{a, -b + depth_m}, {0.0, 1.0}, side_m, depth_m, 0.1}, hardships, random, solids);
  AppendHouses({{-a, b - depth_m}, {0.0, -1.0}, side_m, depth_m, 0.1}, hardships, random, solids);
}

/// The houses across the street, with alleys between some of them.
void AppendRing(const Eigen::Vector2d& half,
                const StreetHardships& hardships,
                Random& random,
                std::vector<Solid>& solids) {
  constexpr double kDepth_m = 10.0;
  const double a = half.x();
  const double b = half.y();
  const double long_m = 2.0 * (a + kDepth_m);
  AppendHouses({{a + kDepth_m, -b}, {-1.0, 0.0}, long_m, kDepth_m, 0.3}, hardships, random, solids);
  AppendHouses({{-a - kDepth_m, b}, {1.0, 0.0}, long_m, kDepth_m, 0.3}, hardships, random, solids);
  AppendHouses({{-a, -b}, {0.0, 1.0}, 2.0 * b, kDepth_m, 0.3}, hardships, random, solids);
  AppendHouses({{a, b}, {0.0, -1.0}, 2.0 * b, kDepth_m, 0.3}, hardships, random, solids);
}

void AppendTree(const Eigen::Vector2d& place, Random& random, std::vector<Solid>& solids) {
  const Eigen::Vector2d along(1.0, 0.0);
  const double trunk_m = random.Uniform(2.6, 3.4);
  solids.push_back(
      UprightSolid(SolidKind::kPole, place, along, {0.25, 0.25, trunk_m + 0.4}, 0.0, random));
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector2d shift(random.Uniform(-0.9, 0.9), random.Uniform(-0.9, 0.9));
    const double size_m = random.Uniform(0.8, 1.6);
    solids.push_back(UprightSolid(SolidKind::kCrown,
                                  place + shift,
                                  along,
                                  {size_m, size_m, 0.9 * size_m},
                                  trunk_m + random.Uniform(-0.4, 1.3),
                                  random));
  }
}

/// Both kerbs: cars, trees, lamp posts and hedges at random distances.
void AppendKerbside(const StreetLayout& layout, Random& random, std::vector<Solid>& solids) {
  using Profile = StreetProfile;
  for (double s = 0.0; s < layout.axis.length_m(); s += random.Uniform(5.5, 9.0)) {
    const PathPlace place = layout.axis.At(s);
    const double kind = random.Uniform();
    if (kind < 0.6 && IsStraightAt(layout, s)) {
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
      solids.push_back(UprightSolid(
          SolidKind::kPole, kerb, place.direction, {0.16, 0.16, height_m}, 0.0, random));
    } else {
      const Eigen::Vector3d size(random.Uniform(1.0, 2.5), 0.5, random.Uniform(0.5, 1.1));
      solids.push_back(UprightSolid(
          SolidKind::kHedge, kerb - 0.3 * place.Left(), place.direction, size, 0.0, random));
    }
  }
}

}  // namespace

std::vector<Solid> MakeStreetSolids(const StreetLayout& layout,
                                    uint64_t seed,
                                    const StreetHardships& hardships) {
  Random random(seed);
  std::vector<Solid> solids;
  AppendBlock(
      (layout.half_m.array() + StreetProfile::kInnerFacade_m).matrix(), hardships, random, solids);
  AppendRing(
      (layout.half_m.array() + StreetProfile::kOuterFacade_m).matrix(), hardships, random, solids);
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
