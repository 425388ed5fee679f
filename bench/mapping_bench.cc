// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// One cluster from verified matches to the final model, one thread: the built-in corridor with
/// bends, 731 features per panorama, 0.5 px noise at 5400 px, 2 % wrong matches, seed 1. Arguments:
/// panoramas; 0: begun with a seed pair, 1: with all images at once. Counters: images registered,
/// residual RMS in pixels, RMSE of the centres of every 30 cameras in a row in millimetres; and the
/// same of `Floor`: least squares started at the truth with all true observations and no wrong one,
/// which nothing can be expected to beat.

#include <benchmark/benchmark.h>

#include <cmath>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/estimators/compare_poses.h"
#include "core/estimators/estimate_two_view.h"
#include "core/estimators/two_view_options.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/reconstruct_cluster.h"
#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"

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

ClusterProblem MakeProblem(const Corridor& corridor) {
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

/// The true street with every observation of every point that two panoramas see.
BundleProblem TrueProblem(const Corridor& corridor) {
  std::vector<uint32_t> views(corridor.points_in_world.size(), 0);
  for (const auto& points : corridor.point_of_feature) {
    for (const uint32_t point : points) ++views[point];
  }
  BundleProblem problem{.cams_from_world = corridor.cams_from_world,
                        .points_in_world = corridor.points_in_world};
  for (uint32_t image = 0; image < corridor.features.size(); ++image) {
    const Features& features = corridor.features[image];
    for (FeatureIndex f = 0; f < features.size(); ++f) {
      const uint32_t point = corridor.point_of_feature[image][f];
      if (views[point] < 2) continue;
      problem.observations.push_back({.pose = image,
                                      .point = point,
                                      .bearing = features.Bearing(f),
                                      .sigma_rad = features.sigma_rad[f]});
    }
  }
  return problem;
}

double WindowRmseMm(std::span<const Rigid3> cams, std::span<const Rigid3> truth) {
  const auto errors = ComparePoses(cams, truth);
  return errors ? 1000.0 * errors->window_rmse_m : 0.0;
}

void Mapping(benchmark::State& state) {
  const Corridor corridor = MakeCorridor({.panoramas = static_cast<int>(state.range(0))});
  const ClusterProblem problem = MakeProblem(corridor);
  const MappingOptions options = {.start = state.range(1) == 0 ? MappingStart::kIncremental
                                                               : MappingStart::kGlobal};
  for (auto _ : state) {
    const auto result = ReconstructCluster(problem, options, {});
    if (!result.ok() || result->submodels.empty()) {
      state.SkipWithError("no reconstruction");
      break;
    }
    std::vector<Rigid3> cams;
    std::vector<Rigid3> truth;
    for (const auto& [id, image] : result->submodels[0].images) {
      cams.push_back(image.cam_from_world);
      truth.push_back(corridor.cams_from_world[id.value]);
    }
    state.counters["registered"] = static_cast<double>(cams.size());
    state.counters["rms_px"] = result->residual_rms_px;
    state.counters["window_mm"] = WindowRmseMm(cams, truth);
    state.counters["observations"] = static_cast<double>(result->submodels[0].NumObservations());
  }
}
BENCHMARK(Mapping)
    ->ArgNames({"panoramas", "global"})
    ->ArgsProduct({{50, 100, 200, 400, 800}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

void Floor(benchmark::State& state) {
  const Corridor corridor = MakeCorridor({.panoramas = static_cast<int>(state.range(0))});
  BundleProblem problem = TrueProblem(corridor);
  const BundleOptions how = {.loss = BundleLoss::kLeastSquares, .function_tolerance = 1e-10};
  for (auto _ : state) {
    const auto report = AdjustBundle(problem, how, {});
    if (!report.ok()) {
      state.SkipWithError("no adjustment");
      break;
    }
    // The cost is in units of the features' sigma, one pixel.
    state.counters["rms_px"] =
        std::sqrt(2.0 * report->final_cost / static_cast<double>(problem.observations.size()));
    state.counters["window_mm"] = WindowRmseMm(problem.cams_from_world, corridor.cams_from_world);
    state.counters["observations"] = static_cast<double>(problem.observations.size());
  }
}
BENCHMARK(Floor)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace orbweave
