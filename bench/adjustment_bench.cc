// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"
#include "tests/support/partitioned_ba/adjust_partitioned.h"

/// Adjustment of a synthetic corridor (seed 1, noise 0.5 px of 5400). `step_per_observation` is the
/// time of one Levenberg-Marquardt step over the number of observations, set-up included;
/// `bytes_per_observation` the process's peak of memory during the adjustment less what it held
/// before (the scene), over the number of observations.

namespace orbweave {
namespace {

Eigen::Vector3d Noise(Random& random, double sigma) {
  const double x = random.Normal();
  const double y = random.Normal();
  return sigma * Eigen::Vector3d(x, y, random.Normal());
}

/// All panoramas but the held ones and all points, off by centimetres as a merged model is.
BundleProblem CorridorProblem(int panoramas, const std::vector<uint8_t>& pose_is_fixed) {
  const Corridor corridor = MakeCorridor({.panoramas = panoramas});
  Random random(1);
  BundleProblem problem;
  problem.pose_is_fixed = pose_is_fixed;
  for (const Rigid3& truth : corridor.cams_from_world) {
    const bool is_fixed =
        !pose_is_fixed.empty() && pose_is_fixed[problem.cams_from_world.size()] != 0;
    const Eigen::Quaterniond R = truth.rotation * RotationFromVector(Noise(random, 1e-3));
    const Eigen::Vector3d C = truth.Centre() + Noise(random, 0.02);
    problem.cams_from_world.push_back(is_fixed ? truth : Rigid3::FromCentre(R, C));
  }
  for (const Eigen::Vector3d& truth : corridor.points_in_world) {
    problem.points_in_world.push_back(truth + Noise(random, 0.05));
  }
  for (uint32_t pose = 0; pose < corridor.features.size(); ++pose) {
    const Features& features = corridor.features[pose];
    for (FeatureIndex f = 0; f < features.size(); ++f) {
      problem.observations.push_back({.pose = pose,
                                      .point = corridor.point_of_feature[pose][f],
                                      .bearing = features.Bearing(f),
                                      .sigma_rad = features.sigma_rad[f]});
    }
  }
  return problem;
}

/// A line of /proc/self/status in bytes, e.g. "VmHWM:".
double StatusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == name && status >> kilobytes) return 1024.0 * kilobytes;
  }
  return 0.0;
}

/// Gives freed memory back and lets the peak (VmHWM) start anew.
void ResetPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

void CountSteps(benchmark::State& state, const BundleProblem& problem, int64_t steps) {
  const auto work = static_cast<double>(steps) * static_cast<double>(problem.observations.size());
  state.counters["observations"] = static_cast<double>(problem.observations.size());
  state.counters["steps"] =
      benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kAvgIterations);
  state.counters["step_per_observation"] =
      benchmark::Counter(work, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void RunAdjustment(benchmark::State& state,
                   const BundleProblem& start,
                   const BundleOptions& options) {
  int64_t steps = 0;
  double peak_bytes = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    BundleProblem problem = start;
    ResetPeak();
    const double scene_bytes = StatusBytes("VmRSS:");
    state.ResumeTiming();
    const absl::StatusOr<BundleReport> report = AdjustBundle(problem, options, {});
    state.PauseTiming();
    steps += report->iterations;
    peak_bytes = std::max(peak_bytes, StatusBytes("VmHWM:") - scene_bytes);
    state.ResumeTiming();
  }
  state.counters["bytes_per_observation"] =
      peak_bytes / static_cast<double>(start.observations.size());
  CountSteps(state, start, steps);
}

void BM_AdjustCorridor(benchmark::State& state, BundleSolver solver, BundleLoss loss) {
  RunAdjustment(state,
                CorridorProblem(static_cast<int>(state.range(0)), {}),
                {.loss = loss, .initial_lambda = 1e-8, .solver = solver});
}

/// Growth: ten steps at each length, whether they converge or not.
void BM_AdjustLongCorridor(benchmark::State& state) {
  RunAdjustment(state,
                CorridorProblem(static_cast<int>(state.range(0)), {}),
                {.max_iterations = 10, .function_tolerance = 1e-16, .initial_lambda = 1e-8});
}

/// The same path of steps, subproblem by subproblem: consecutive panoramas in equal shares.
/// `message_bytes` is the largest system that a subproblem sends per step.
void BM_AdjustPartitioned(benchmark::State& state) {
  const BundleProblem start = CorridorProblem(static_cast<int>(state.range(0)), {});
  const auto num_subproblems = static_cast<uint32_t>(state.range(1));
  const size_t num_poses = start.cams_from_world.size();
  std::vector<uint32_t> owners;
  for (size_t pose = 0; pose < num_poses; ++pose) {
    owners.push_back(static_cast<uint32_t>(pose * num_subproblems / num_poses));
  }
  int64_t steps = 0;
  size_t message_bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    BundleProblem problem = start;
    state.ResumeTiming();
    const absl::StatusOr<PartitionedReport> report =
        AdjustPartitioned(problem, owners, num_subproblems, {.initial_lambda = 1e-8}, {});
    steps += report->bundle.iterations;
    const std::vector<size_t>& bytes = report->message_bytes_of_subproblem;
    message_bytes = *std::max_element(bytes.begin(), bytes.end());
  }
  CountSteps(state, start, steps);
  state.counters["message_bytes"] = static_cast<double>(message_bytes);
}

/// Twelve free panoramas amid held ones, as after each registration.
void BM_AdjustLocally(benchmark::State& state, BundleSolver solver) {
  std::vector<uint8_t> pose_is_fixed(24, 1);
  for (size_t i = 6; i < 18; ++i) pose_is_fixed[i] = 0;
  RunAdjustment(state, CorridorProblem(24, pose_is_fixed), {.solver = solver});
}

BENCHMARK_CAPTURE(BM_AdjustLocally, schur, BundleSolver::kSchur)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustLocally, ceres, BundleSolver::kCeres)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustCorridor, schur_cauchy, BundleSolver::kSchur, BundleLoss::kCauchy)
    ->Arg(100)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AdjustLongCorridor)
    ->Arg(2000)
    ->Arg(4000)
    ->Arg(8000)
    ->Arg(16000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustCorridor,
                  schur_least_squares,
                  BundleSolver::kSchur,
                  BundleLoss::kLeastSquares)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AdjustPartitioned)
    ->Args({400, 1})
    ->Args({400, 4})
    ->Args({400, 16})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_AdjustCorridor, ceres_cauchy, BundleSolver::kCeres, BundleLoss::kCauchy)
    ->Arg(100)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbweave
