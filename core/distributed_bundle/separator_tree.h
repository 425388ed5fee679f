// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/distributed_bundle/adjustment_block.h"

namespace orbweave {

/// Adds the systems of its children and eliminates what nobody outside uses.
struct SeparatorNode {
  std::vector<uint32_t> children{};  ///< below num_blocks: a block; else num_blocks + node
  std::vector<SeparatorId> keep{};   ///< ascending; empty at the root
};

/// The order in which blocks are added: fixed by who shares separators with whom, so that sums have
/// the same bits whoever forms them.
struct SeparatorTree {
  uint32_t num_blocks = 0;
  std::vector<SeparatorNode> nodes{};  ///< children before parents, the root last
};

/// Eight children a node.
inline constexpr int kTreeDoublings = 3;

/// Nested elimination: from the blocks upwards, groups that share the most separators are joined
/// (heavy-edge matching), `doublings` times per level (2^doublings children at most), until one is
/// left. On a street a group keeps the separators at its two ends, whatever its length.
/// `doublings` = 0: a root over all blocks.
[[nodiscard]] SeparatorTree MakeSeparatorTree(
    const std::vector<std::vector<SeparatorId>>& separators_of_block,
    int doublings = kTreeDoublings);

}  // namespace orbweave
