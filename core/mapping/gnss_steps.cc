// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/gnss_steps.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kFewestRatios = 20;
constexpr double kSmallestFactor = 0.05;
constexpr double kMedianOfNormal = 0.6745;

}  // namespace

std::vector<GnssStep> GnssSteps(const ClusterProblem& problem,
                                const CorrespondenceGraph& graph,
                                std::span<const uint32_t> pairs) {
  std::vector<GnssStep> steps(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    const PosePrior& a = problem.images[graph.pairs[pairs[i]].a].prior;
    const PosePrior& b = problem.images[graph.pairs[pairs[i]].b].prior;
    if (!a.position_in_enu || !b.position_in_enu) continue;
    const double length_m = (*b.position_in_enu - *a.position_in_enu).head<2>().norm();
    if (!(length_m > 0.0)) continue;
    const double sigma_m = std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m);
    steps[i] = {.log_length = std::log(length_m), .sigma = sigma_m / length_m};
  }
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

}  // namespace orbweave
