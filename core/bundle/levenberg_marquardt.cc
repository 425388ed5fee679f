// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

// Below, the depth of a point seen once is lost in rounding; above, a step no longer moves
// anything.
constexpr double kMinLambda = 1e-12;
constexpr double kMaxLambda = 1e12;
// Relative decrease below which the loss is linearised as Newton would: it ends the slow
// convergence of the weights, and leads astray far from the optimum.
constexpr double kBendBelow = 0.01;

void Accept(double trial_cost,
            double predicted_decrease,
            const BundleOptions& options,
            LevenbergMarquardt& path) {
  const double decrease = path.cost - trial_cost;
  const double gain = predicted_decrease > 0.0 ? decrease / predicted_decrease : 0.0;
  const double factor = std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3));
  path.control.lambda = std::max(kMinLambda, path.control.lambda * factor);
  path.control.is_bent = decrease < kBendBelow * path.cost;
  path.converged = decrease <= options.function_tolerance * path.cost;
  path.growth = 2.0;
  path.cost = trial_cost;
  path.accepted = true;
}

void Reject(LevenbergMarquardt& path) {
  path.control.is_bent = false;
  path.control.lambda *= path.growth;
  path.growth *= 2.0;
  path.accepted = false;
}

}  // namespace

LevenbergMarquardt StartLevenbergMarquardt(double initial_cost, const BundleOptions& options) {
  return {.control = {.lambda = std::max(options.initial_lambda, kMinLambda)},
          .cost = initial_cost};
}

bool WantsStep(const LevenbergMarquardt& path, const BundleOptions& options) {
  return !path.converged && path.iterations < options.max_iterations &&
         path.control.lambda <= kMaxLambda;
}

LevenbergMarquardt AfterTrial(LevenbergMarquardt path,
                              double trial_cost,
                              double predicted_decrease,
                              const BundleOptions& options) {
  ++path.iterations;
  if (trial_cost < path.cost) {
    Accept(trial_cost, predicted_decrease, options, path);
    return path;
  }
  // Nothing left to gain: the decrease drowns in the rounding of the cost.
  path.converged = predicted_decrease <= 1e-13 * path.cost;
  Reject(path);
  return path;
}

LevenbergMarquardt AfterFailure(LevenbergMarquardt path) {
  ++path.iterations;
  Reject(path);
  return path;
}

}  // namespace orbweave
