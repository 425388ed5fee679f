// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/distributed_bundle/adjustment_block.h"

namespace orbweave {

/// Divides a problem among the blocks that own its panoramas (each pose has one owner <
/// num_blocks). Tracks within one block stay there; AssignTracks decides about the others. A prior
/// goes to the owner of its pose, a bias' own prior to the first block that uses it. Held poses and
/// fixed points are constants of every block that needs them. A block may be empty.
[[nodiscard]] std::vector<AdjustmentBlock> DivideIntoBlocks(
    const BundleProblem& problem, const std::vector<uint32_t>& owner_of_pose, uint32_t num_blocks);

/// Writes the poses and points of adjusted blocks into the problem they were divided from.
void GatherBlocks(const std::vector<AdjustmentBlock>& blocks, BundleProblem& problem);

}  // namespace orbweave
