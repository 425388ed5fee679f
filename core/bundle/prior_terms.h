// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/reduced_system.h"

namespace orbweave {

/// Half the Cauchy losses (scale one sigma) of the position priors, the squares of the biases and
/// those of the direction priors.
[[nodiscard]] double PriorCost(const BundleProblem& problem, const BundleState& state);

/// Their normal equations. A bias takes a block whose rotation rows stand alone.
void AddPriorTerms(const BundleProblem& problem,
                   const BundleLayout& layout,
                   const BundleState& state,
                   ReducedSystem& system);

}  // namespace orbweave
