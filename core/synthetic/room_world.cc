// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/room_world.h"

#include <algorithm>
#include <numbers>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kFloor_m = -1.5;
constexpr double kCeiling_m = 1.2;
constexpr double kBeyondLoop_m = 1.4;
constexpr double kThickness_m = 0.1;

StreetLayout LoopOf(double length_m) {
  constexpr double kRadius_m = 0.6;
  constexpr double kAspect = 1.6;
  const double perimeter_m = std::max(length_m, 12.0) + (8.0 - 2.0 * std::numbers::pi) * kRadius_m;
  const double b = perimeter_m / (4.0 * (1.0 + kAspect));
  const double a = kAspect * b;
  return {{a, b}, StreetPath({{-a, b}, {a, b}, {a, -b}, {-a, -b}}, kRadius_m, true)};
}

/// Collects boxes; heights are above the floor.
struct Furnisher {
  Random random;
  std::vector<Solid> solids{};

  void Put(SolidKind kind,
           const Eigen::Vector2d& middle,
           const Eigen::Vector2d& along,
           const Eigen::Vector3d& size_m,
           double base_m) {
    solids.push_back({.kind = kind,
                      .centre = {middle.x(), middle.y(), kFloor_m + base_m + size_m.z() / 2.0},
                      .half = size_m / 2.0,
                      .along = along,
                      .seed = static_cast<uint32_t>(random.Next() >> 32)});
  }

  /// One wall whose inner face runs from `start` along `along`, the room on its left; furniture
  /// stands before it and pictures hang above.
  void PutWall(const Eigen::Vector2d& start, const Eigen::Vector2d& along, double length_m) {
    const Eigen::Vector2d inwards(-along.y(), along.x());
    Put(SolidKind::kPlaster,
        start + length_m / 2.0 * along - kThickness_m / 2.0 * inwards,
        along,
        {length_m + 2.0 * kThickness_m, kThickness_m, kCeiling_m - kFloor_m},
        0.0);
    for (double s = 0.3; s < length_m - 1.2;) {
      const double width_m = random.Uniform(0.5, 1.5);
      const double kind = random.Uniform();
      const Eigen::Vector2d middle = start + (s + width_m / 2.0) * along;
      if (kind < 0.3) {
        const double high_m = random.Uniform(1.7, 2.2);
        Put(SolidKind::kFurniture, middle + 0.2 * inwards, along, {width_m, 0.4, high_m}, 0.0);
      } else if (kind < 0.65) {
        const double high_m = random.Uniform(0.4, 1.0);
        Put(SolidKind::kFurniture, middle + 0.25 * inwards, along, {width_m, 0.5, high_m}, 0.0);
      }
      if (kind > 0.4 && kind < 0.8) {
        const double high_m = random.Uniform(0.4, 0.8);
        const double wide_m = random.Uniform(0.3, 0.9);
        Put(SolidKind::kPicture, middle + 0.02 * inwards, along, {wide_m, 0.04, high_m}, 1.3);
      }
      s += width_m + random.Uniform(0.1, 0.8);
    }
  }

  /// Tables and boxes inside the loop, 0.5 m clear of it.
  void PutMiddle(const Eigen::Vector2d& half) {
    const Eigen::Vector2d free = half - Eigen::Vector2d::Constant(1.0);
    for (int i = 0; i < 6 && free.minCoeff() > 0.0; ++i) {
      const Eigen::Vector2d place(random.Uniform(-free.x(), free.x()),
                                  random.Uniform(-free.y(), free.y()));
      const Eigen::Vector3d size(
          random.Uniform(0.4, 0.9), random.Uniform(0.4, 0.7), random.Uniform(0.4, 0.9));
      Put(SolidKind::kFurniture, place, {1.0, 0.0}, size, 0.0);
    }
  }
};

}  // namespace

StreetWorld MakeRoomWorld(double length_m, uint64_t seed) {
  StreetWorld world{.layout = LoopOf(length_m)};
  Furnisher room{Random(seed)};
  const Eigen::Vector2d half = world.layout.half_m + Eigen::Vector2d::Constant(kBeyondLoop_m);
  const Eigen::Vector2d x(1.0, 0.0);
  const Eigen::Vector3d slab(2.0 * half.x(), 2.0 * half.y(), kThickness_m);
  room.Put(SolidKind::kFloor, {0.0, 0.0}, x, slab, -kThickness_m);
  room.Put(SolidKind::kPlaster, {0.0, 0.0}, x, slab, kCeiling_m - kFloor_m);
  room.PutWall({-half.x(), -half.y()}, {1.0, 0.0}, 2.0 * half.x());
  room.PutWall({half.x(), -half.y()}, {0.0, 1.0}, 2.0 * half.y());
  room.PutWall({half.x(), half.y()}, {-1.0, 0.0}, 2.0 * half.x());
  room.PutWall({-half.x(), half.y()}, {0.0, -1.0}, 2.0 * half.y());
  room.PutMiddle(world.layout.half_m);
  world.solids = std::move(room.solids);
  world.grid = SolidGrid(world.solids);
  world.seed = static_cast<uint32_t>(Random(seed).Next() >> 32);
  return world;
}

}  // namespace orbweave
