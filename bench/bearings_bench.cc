// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Cost of the camera, the minimal solvers and the distances on the sphere, one call each on random
/// bearings of the whole sphere (seed 1).

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "core/geometry/eight_point.h"
#include "core/geometry/epipolar.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/five_point.h"
#include "core/geometry/p3p.h"
#include "core/geometry/upright_three_point.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kCount = 1024;

const testing::TwoViewWorld& Pairs() {
  static const testing::TwoViewWorld world = testing::MakeTwoViewWorld(1, kCount);
  return world;
}

void BearingFromPixel(benchmark::State& state) {
  const EquirectangularCamera camera = {5376, 2688};
  double column = 0.0;
  for (auto _ : state) {
    column = column < 5000.0 ? column + 1.7 : 0.5;
    benchmark::DoNotOptimize(camera.BearingFromPixel({column, 0.4 * column}));
  }
}
BENCHMARK(BearingFromPixel);

void PixelFromBearing(benchmark::State& state) {
  const EquirectangularCamera camera = {5376, 2688};
  size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(camera.PixelFromBearing(Pairs().bearings_a[i++ % kCount]));
}
BENCHMARK(PixelFromBearing);

void SymmetricEpipolarAngles(benchmark::State& state) {
  const auto& world = Pairs();
  size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % kCount;
    benchmark::DoNotOptimize(
        SymmetricEpipolarAngle(world.b_from_a, world.bearings_a[i], world.bearings_b[i]));
  }
}
BENCHMARK(SymmetricEpipolarAngles);

/// `kSize` consecutive pairs, another start each time.
template <size_t kSize>
std::pair<std::span<const Vector3d, kSize>, std::span<const Vector3d, kSize>> NextSample(
    size_t& i) {
  i = (i + 1) % (kCount - kSize);
  return {std::span<const Vector3d, kSize>(Pairs().bearings_a.data() + i, kSize),
          std::span<const Vector3d, kSize>(Pairs().bearings_b.data() + i, kSize)};
}

void FivePoint(benchmark::State& state) {
  size_t i = 0;
  for (auto _ : state) {
    const auto [a, b] = NextSample<5>(i);
    benchmark::DoNotOptimize(SolveFivePoint(a, b));
  }
}
BENCHMARK(FivePoint);

void EightPoint(benchmark::State& state) {
  size_t i = 0;
  for (auto _ : state) {
    const auto [a, b] = NextSample<8>(i);
    benchmark::DoNotOptimize(SolveEightPoint(a, b));
  }
}
BENCHMARK(EightPoint);

void UprightThreePoint(benchmark::State& state) {
  size_t i = 0;
  for (auto _ : state) {
    const auto [a, b] = NextSample<3>(i);
    benchmark::DoNotOptimize(SolveUprightThreePoint(a, b));
  }
}
BENCHMARK(UprightThreePoint);

void P3p(benchmark::State& state) {
  size_t i = 0;
  for (auto _ : state) {
    const auto b = NextSample<3>(i).second;
    const std::span<const Vector3d, 3> points(Pairs().points_in_a.data() + i, 3);
    benchmark::DoNotOptimize(SolveP3p(b, points));
  }
}
BENCHMARK(P3p);

}  // namespace
}  // namespace orbweave
