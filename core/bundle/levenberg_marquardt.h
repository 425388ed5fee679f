// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bundle_options.h"

namespace orbweave {

/// What a linearisation depends on beside the state.
struct StepControl {
  double lambda = 1e-6;  ///< damping over the mean diagonal entry of each 3x3 block
  bool is_bent = false;  ///< RobustLoss::Bent

  friend bool operator==(const StepControl&, const StepControl&) = default;
};

/// Where a Levenberg-Marquardt path stands: a plain value, to be kept between two steps. Damping
/// after Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05; steps are accepted on
/// the true cost.
struct LevenbergMarquardt {
  StepControl control{};
  double growth = 2.0;  ///< of lambda at the next rejection
  double cost = 0.0;    ///< of the last accepted state
  int iterations = 0;
  bool converged = false;
  bool accepted = false;  ///< whether the last step was
};

[[nodiscard]] LevenbergMarquardt StartLevenbergMarquardt(double initial_cost,
                                                         const BundleOptions& options);

/// Whether another step should be tried.
[[nodiscard]] bool WantsStep(const LevenbergMarquardt& path, const BundleOptions& options);

/// After a step to `trial_cost` of which the linear model predicted the decrease: the step counts
/// as accepted when the cost fell.
[[nodiscard]] LevenbergMarquardt AfterTrial(LevenbergMarquardt path,
                                            double trial_cost,
                                            double predicted_decrease,
                                            const BundleOptions& options);

/// After a system that was not positive definite: no step, more damping.
[[nodiscard]] LevenbergMarquardt AfterFailure(LevenbergMarquardt path);

}  // namespace orbweave
