// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/adjustment_records.h"

namespace orbweave {

struct AdvancedAdjustment {
  AdjustmentProgress progress{};
  std::vector<SubproblemTask>
      tasks{};  ///< in the order of the subproblems that are asked; empty: all done
};

/// The first round of the worlds that are distributed (a flag per world); `subproblems` of all
/// worlds are sorted by world.
[[nodiscard]] AdvancedAdjustment StartAdjustment(std::vector<SubproblemPlace> subproblems,
                                                 const std::vector<uint8_t>& is_distributed,
                                                 const GlobalAdjustOptions& options,
                                                 const BundleOptions& bundle);

/// The next round, from the results of all tasks of the last one, in their order. InvalidArgument:
/// another number of them. DataLoss: they are not what was asked for (CheckReplies).
[[nodiscard]] absl::StatusOr<AdvancedAdjustment> AdvanceAdjustment(
    AdjustmentProgress progress,
    std::vector<SubproblemResult> results,
    const GlobalAdjustOptions& options,
    const BundleOptions& bundle);

}  // namespace orbweave
