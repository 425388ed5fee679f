// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Matching of two panoramas' descriptors on one thread: random bytes of the size of RootSIFT's
/// (seeds 1 and 2), keypoints uniform on the sphere. Argument: descriptors per panorama.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/features/find_nearest_two.h"
#include "core/features/nearest_in_planes.h"

namespace orbweave {
namespace {

/// Bytes with the length and spread of RootSIFT, keypoints uniform on the sphere.
Features RandomFeatures(int64_t count, uint64_t seed) {
  Random random(seed);
  Features features{.camera = {.width_px = 5376, .height_px = 2688}};
  for (int64_t i = 0; i < count; ++i) {
    const double latitude = std::asin(random.Uniform(-1.0, 1.0));
    features.keypoints.push_back(
        {.x_px = static_cast<float>(random.Uniform(0.0, 5376.0)),
         .y_px = static_cast<float>((0.5 + latitude / std::numbers::pi) * 2688.0)});
    for (int k = 0; k < kDescriptorSize; ++k) {
      features.descriptors.push_back(static_cast<uint8_t>(random.Index(90)));
    }
  }
  return features;
}

bool IsAvailable(DistanceKernel kernel) {
  const std::vector<DistanceKernel> available = AvailableDistanceKernels();
  return std::find(available.begin(), available.end(), kernel) != available.end();
}

void NearestTwoBothDirections(benchmark::State& state, DistanceKernel kernel) {
  if (!IsAvailable(kernel)) return state.SkipWithError("not on this processor");
  const Features a = RandomFeatures(state.range(0), 1);
  const Features b = RandomFeatures(state.range(0), 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(FindNearestTwo(a.descriptors, b.descriptors, kernel));
  }
}
BENCHMARK_CAPTURE(NearestTwoBothDirections, portable, DistanceKernel::kPortable)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(NearestTwoBothDirections, avx2, DistanceKernel::kAvx2)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(NearestTwoBothDirections, avx512_vnni, DistanceKernel::kAvx512Vnni)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);

void GuidedByEpipolarPlanes(benchmark::State& state, DistanceKernel kernel) {
  if (!IsAvailable(kernel)) return state.SkipWithError("not on this processor");
  const PairSide a(RandomFeatures(state.range(0), 1));
  const PairSide b(RandomFeatures(state.range(0), 2));
  for (auto _ : state) {
    const NearestInPlanes planes(
        a, b, Eigen::Vector3d::UnitZ(), a.features.camera.AngleFromPixels(4.0), kernel);
    benchmark::DoNotOptimize(planes.Find(Eigen::Quaterniond::Identity()));
  }
}
BENCHMARK_CAPTURE(GuidedByEpipolarPlanes, portable, DistanceKernel::kPortable)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(GuidedByEpipolarPlanes, avx2, DistanceKernel::kAvx2)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(GuidedByEpipolarPlanes, avx512_vnni, DistanceKernel::kAvx512Vnni)
    ->Arg(8192)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbweave
