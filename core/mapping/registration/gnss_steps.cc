// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/gnss_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kFewestRatios = 20;
constexpr double kSmallestFactor = 0.05;
constexpr double kMedianOfNormal = 0.6745;

}  // namespace

GnssStep StepBetween(const ClusterProblem& problem, ImageSlot a, ImageSlot b) {
  const PosePrior& at_a = problem.images[a].prior;
  const PosePrior& at_b = problem.images[b].prior;
  if (!at_a.position_in_enu || !at_b.position_in_enu) return {};
  const double length_m = DistanceBetween(at_a, at_b);
  if (!(length_m > 0.0)) return {};
  return {.log_length = std::log(length_m), .sigma = SigmaBetween(at_a, at_b) / length_m};
}

std::vector<GnssStep> GnssSteps(const ClusterProblem& problem,
                                const CorrespondenceGraph& graph,
                                std::span<const uint32_t> pairs) {
  std::vector<GnssStep> steps;
  for (const uint32_t p : pairs)
    steps.push_back(StepBetween(problem, graph.pairs[p].a, graph.pairs[p].b));
  return steps;
}

double FactorOfSteps(std::span<const GnssStep> steps, std::span<const SeenRatio> ratios) {
  std::vector<double> errors;
  for (const SeenRatio& ratio : ratios) {
    const GnssStep& a = steps[ratio.a];
    const GnssStep& b = steps[ratio.b];
    const double sigma = std::hypot(a.sigma, b.sigma);
    if (!std::isfinite(sigma)) continue;
    errors.push_back(std::abs(ratio.log_ratio - (b.log_length - a.log_length)) / sigma);
  }
  if (errors.size() < kFewestRatios) return 1.0;
  return std::max(kSmallestFactor, UpperMedian(errors) / kMedianOfNormal);
}

double FactorOfErrors(std::vector<double> errors) {
  constexpr size_t kFew = 8;
  constexpr double kFactorOfFew = 2.0;
  constexpr double kShare = 0.25;
  constexpr double kQuantileOfNormal = 0.3186;
  const bool are_few = errors.size() < kFew;
  const double measured = Quantile(std::move(errors), kShare) / kQuantileOfNormal;
  return are_few ? std::max(measured, kFactorOfFew) : measured;
}

}  // namespace orbweave
