// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/partitioned_ba/global_options.h"
#include "core/partitioned_ba/partitioned_lm.h"
#include "core/partitioned_ba/subproblem_solver.h"

namespace orbweave {

/// Where the adjustment of one world stands between two rounds of its subproblems: a plain value.
struct WorldProgress {
  int phase = 0;  ///< rounds with the robust loss, then one of least squares
  LmRequest::Work asked = LmRequest::Work::kEvaluate;
  bool is_done = false;
  PartitionedLm path{};
  GlobalAdjustReport report{};
};

/// What to ask the subproblems for next, the same work of all, in their order.
struct WorldRound {
  WorldProgress path{};
  std::vector<LmRequest> requests{};  ///< empty: the world is done
};

[[nodiscard]] inline SubproblemOptions SubproblemOptionsOf(const GlobalAdjustOptions& options,
                                                           const BundleOptions& bundle) {
  return {bundle, options.max_error_px, options.min_angle_deg};
}

/// The first round of a world of `num_subproblems` subproblems.
[[nodiscard]] WorldRound StartWorld(size_t num_subproblems,
                                    const GlobalAdjustOptions& options,
                                    const BundleOptions& bundle);

/// The next round, from all replies to the last one. Levenberg-Marquardt as in AdjustBundle, step
/// by step the same to rounding: one round linearises and eliminates, one tries the step. Each of
/// `options.rounds` phases with the given loss ends with a filter, as does a last one of least
/// squares.
[[nodiscard]] WorldRound AdvanceWorld(WorldProgress path,
                                      std::span<const LmReply> replies,
                                      const GlobalAdjustOptions& options,
                                      const BundleOptions& bundle);

}  // namespace orbweave
