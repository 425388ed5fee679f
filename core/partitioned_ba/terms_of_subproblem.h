// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bundle_state.h"
#include "core/partitioned_ba/bundle_subproblem.h"
#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// The numbers of a subproblem: a pose per image that is not loose, in order; a point per split
/// track, then one per track of the scene, in order. Ids: images by their own, biases by group,
/// split tracks by theirs; inner points have ids above those.
[[nodiscard]] BundleSubproblem TermsOf(const Subproblem& subproblem);

/// The subproblem with poses, points and biases of a state of its terms.
[[nodiscard]] Subproblem WithState(Subproblem subproblem, const BundleState& state);

}  // namespace orbweave
