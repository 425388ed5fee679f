// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Descriptor matching, one thread. Arguments: descriptors per panorama.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/features/match_descriptors.h"
#include "core/features/nearest_two.h"

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

void BM_FindNearestTwo(benchmark::State& state, DistanceKernel kernel) {
  const Features a = RandomFeatures(state.range(0), 1);
  const Features b = RandomFeatures(state.range(0), 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(FindNearestTwo(a.descriptors, b.descriptors, kernel));
  }
}

void BM_MatchGuided(benchmark::State& state) {
  const Features a = RandomFeatures(state.range(0), 1);
  const Features b = RandomFeatures(state.range(0), 2);
  const Rigid3 b_from_a{Eigen::Quaterniond::Identity(), Eigen::Vector3d::UnitZ()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(MatchGuided(a, b, b_from_a, a.camera.AngleFromPixels(4.0), {}));
  }
}
BENCHMARK(BM_MatchGuided)->Arg(8192)->Unit(benchmark::kMillisecond);

const char* NameOf(DistanceKernel kernel) {
  switch (kernel) {
    case DistanceKernel::kPortable:
      return "BM_FindNearestTwo/portable";
    case DistanceKernel::kAvx2:
      return "BM_FindNearestTwo/avx2";
    case DistanceKernel::kAvx512Vnni:
      return "BM_FindNearestTwo/avx512_vnni";
  }
  return "BM_FindNearestTwo";
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const DistanceKernel kernel : AvailableDistanceKernels()) {
    benchmark::RegisterBenchmark(NameOf(kernel), BM_FindNearestTwo, kernel)
        ->Arg(8192)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace orbweave
