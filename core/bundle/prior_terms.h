// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/gauge.h"
#include "core/bundle/reduced_system.h"

namespace orbweave {

/// diag(1/sigma) (C + bias - position)
[[nodiscard]] Eigen::Vector3d WhitenedResidual(const PositionPrior& prior,
                                               const BundleState& state);

/// Half the Cauchy losses (PositionPrior::loss_sigmas) of the position priors, the squares of the
/// biases and those of the direction priors.
[[nodiscard]] double PriorCost(const BundleProblem& problem, const BundleState& state);

/// Their normal equations. A bias takes a block whose rotation rows stand alone.
void AddPriorTerms(const BundleProblem& problem,
                   const BundleLayout& layout,
                   const BundleState& state,
                   ReducedSystem& system);

/// A spring on the distance that the gauge holds, if any; returns its stiffness. The gradient has
/// no part along the scale, so that the step, too, has none, whatever the stiffness.
double AddDistanceSpring(const Gauge& gauge,
                         const BundleLayout& layout,
                         const BundleState& state,
                         ReducedSystem& system);

}  // namespace orbweave
