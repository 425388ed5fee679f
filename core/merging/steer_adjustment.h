// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/distributed_bundle/block_path.h"
#include "core/merging/adjust_block.h"
#include "core/merging/global_options.h"

namespace orbweave {

/// Where the adjustment of one world stands between two rounds of its blocks: a plain value.
struct WorldPath {
  int phase = 0;  ///< rounds with the robust loss, then one of least squares
  BlockOrder::Work asked = BlockOrder::Work::kBegin;
  bool is_done = false;
  BlockPath path{};
  GlobalAdjustReport report{};
};

/// What to ask the blocks for next, the same work of all, in their order.
struct SteeredRound {
  WorldPath path{};
  std::vector<BlockOrder> orders{};  ///< empty: the world is done
};

[[nodiscard]] inline BlockOptions BlockOptionsOf(const GlobalAdjustOptions& options,
                                                 const BundleOptions& bundle) {
  return {bundle, options.max_error_px, options.min_angle_deg};
}

/// The first round of a world of `num_blocks` blocks.
[[nodiscard]] SteeredRound BeginAdjustment(size_t num_blocks,
                                           const GlobalAdjustOptions& options,
                                           const BundleOptions& bundle);

/// The next round, from all answers to the last one. Levenberg-Marquardt as in AdjustBundle, step
/// by step the same to rounding: one round linearises and eliminates, one tries the step. Each of
/// `options.rounds` phases with the given loss ends with a filter, as does a last one of least
/// squares.
[[nodiscard]] SteeredRound SteerAdjustment(WorldPath path,
                                           std::span<const BlockAnswer> answers,
                                           const GlobalAdjustOptions& options,
                                           const BundleOptions& bundle);

}  // namespace orbweave
