// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bundle_state.h"
#include "core/distributed_bundle/adjustment_block.h"
#include "core/merging/world_block.h"

namespace orbweave {

/// The numbers of a block: a pose per image that is not loose, in order; a point per split track,
/// then one per track of the scene, in order. Ids: images by their own, biases by group, split
/// tracks by theirs; inner points have ids above those.
[[nodiscard]] AdjustmentBlock TermsOf(const WorldBlock& block);

/// The block with poses, points and biases of a state of its terms.
[[nodiscard]] WorldBlock WithState(WorldBlock block, const BundleState& state);

}  // namespace orbweave
