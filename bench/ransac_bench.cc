// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Robust estimation on full-sphere scenes: 1,000 data (or the rays of one track), noise 1 mrad,
/// threshold 4.7 mrad (4 px of 5376), another scene and seed in every iteration. Argument: outliers
/// in percent, or rays per track.

#include <benchmark/benchmark.h>

#include <vector>

#include "core/estimators/estimate_absolute_pose.h"
#include "core/estimators/estimate_two_view.h"
#include "core/estimators/triangulate_rays.h"
#include "core/estimators/two_view_options.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr size_t kCount = 1000;
constexpr uint64_t kScenes = 20;
constexpr double kSigmaRad = 1e-3;
constexpr double kMaxErrorRad = 4.7e-3;

void TwoView(benchmark::State& state, TwoViewSolver solver) {
  std::vector<testing::TwoViewWorld> worlds;
  for (uint64_t seed = 0; seed < kScenes; ++seed) {
    worlds.push_back(testing::MakeTwoViewWorld(
        seed, kCount, 0.01 * static_cast<double>(state.range(0)), kSigmaRad));
  }
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < kCount; ++i) matches.push_back({i, i});
  const ImagePair pair = {ImageId(0), ImageId(1)};
  uint64_t run = 0;
  for (auto _ : state) {
    const auto& world = worlds[run % kScenes];
    benchmark::DoNotOptimize(EstimateTwoView(pair,
                                             world.bearings_a,
                                             world.bearings_b,
                                             matches,
                                             kMaxErrorRad,
                                             {.solver = solver},
                                             {.seed = run++}));
  }
}
BENCHMARK_CAPTURE(TwoView, five_point, TwoViewSolver::kFivePoint)
    ->Arg(30)
    ->Arg(50)
    ->Arg(70)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(TwoView, eight_point, TwoViewSolver::kEightPoint)
    ->Arg(30)
    ->Arg(50)
    ->Unit(benchmark::kMillisecond);

void AbsolutePoseOf(benchmark::State& state) {
  std::vector<testing::ResectionWorld> worlds;
  for (uint64_t seed = 0; seed < kScenes; ++seed) {
    worlds.push_back(testing::MakeResectionWorld(
        seed, kCount, 0.01 * static_cast<double>(state.range(0)), kSigmaRad));
  }
  uint64_t run = 0;
  for (auto _ : state) {
    const auto& world = worlds[run % kScenes];
    benchmark::DoNotOptimize(EstimateAbsolutePose(
        world.bearings, world.points_in_world, kMaxErrorRad, {}, {.seed = run++}));
  }
}
BENCHMARK(AbsolutePoseOf)->Arg(30)->Arg(50)->Arg(70)->Unit(benchmark::kMillisecond);

void Triangulate(benchmark::State& state) {
  const auto world = testing::MakeTrackWorld(1, static_cast<size_t>(state.range(0)), kSigmaRad);
  for (auto _ : state)
    benchmark::DoNotOptimize(TriangulateRays(world.cams_from_world, world.bearings));
}
BENCHMARK(Triangulate)->Arg(2)->Arg(4)->Arg(16);

/// One ray in four is wrong.
void TriangulateWithOutliers(benchmark::State& state) {
  auto world = testing::MakeTrackWorld(1, static_cast<size_t>(state.range(0)), kSigmaRad);
  Random random(2);
  for (size_t i = 0; i < world.bearings.size(); i += 4)
    world.bearings[i] = testing::RandomDirection(random);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        TriangulateRobustly(world.cams_from_world, world.bearings, kMaxErrorRad, 0.02));
  }
}
BENCHMARK(TriangulateWithOutliers)->Arg(4)->Arg(8)->Arg(16);

}  // namespace
}  // namespace orbweave
