// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// One cluster from verified matches to the final model, one thread: the built-in corridor with
/// bends, 731 features per panorama, 0.5 px noise at 5400 px, 2 % wrong matches, seed 1. Argument:
/// panoramas. Counters: images registered, residual RMS in pixels.

#include <benchmark/benchmark.h>

#include "core/estimators/estimate_two_view.h"
#include "core/mapping/reconstruct_cluster.h"
#include "core/synthetic/corridor.h"

namespace orbweave {
namespace {

ClusterImage ToClusterImage(ImageId id, const Features& features) {
  ClusterImage image{.id = id,
                     .camera = features.camera,
                     .sigma_rad = features.sigma_rad,
                     .colors = features.colors};
  for (FeatureIndex f = 0; f < features.size(); ++f) image.bearings.push_back(features.Bearing(f));
  return image;
}

ClusterProblem MakeProblem(int panoramas) {
  const Corridor corridor = MakeCorridor({.panoramas = panoramas});
  ClusterProblem problem;
  for (uint32_t i = 0; i < corridor.features.size(); ++i) {
    problem.images.push_back(ToClusterImage(ImageId(i), corridor.features[i]));
  }
  for (const PairMatches& pair : corridor.pairs) {
    const ClusterImage& a = problem.images[pair.pair.a.value];
    const ClusterImage& b = problem.images[pair.pair.b.value];
    auto geometry = EstimateTwoView(pair.pair,
                                    a.bearings,
                                    b.bearings,
                                    pair.matches,
                                    a.camera.AngleFromPixels(TwoViewOptions{}.max_error_px),
                                    {},
                                    {});
    if (geometry.ok() && geometry->kind != TwoViewKind::kNone) {
      problem.pairs.push_back(*std::move(geometry));
    }
  }
  return problem;
}

void Mapping(benchmark::State& state) {
  const ClusterProblem problem = MakeProblem(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const auto result = ReconstructCluster(problem, {}, {});
    if (!result.ok() || result->components.empty()) {
      state.SkipWithError("no reconstruction");
      break;
    }
    state.counters["registered"] = static_cast<double>(result->components[0].images.size());
    state.counters["rms_px"] = result->residual_rms_px;
  }
}
BENCHMARK(Mapping)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace orbweave
