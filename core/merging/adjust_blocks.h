// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/bundle/adjust_bundle.h"
#include "core/merging/conclude_adjustment.h"
#include "core/merging/global_options.h"

namespace orbweave {

struct AdjustedBlocks {
  std::vector<WorldBlock> blocks{};
  std::vector<BlockSummary> summaries{};  ///< per block
  GlobalAdjustReport report{};            ///< without what ConcludeAdjustment finds
};

/// Adjusts and filters the blocks of one world in this process, on `context.num_threads` threads:
/// BeginAdjustment, SteerAdjustment and BlockWorker as they are when blocks are spread over many.
/// InvalidArgument: bundle.solver is Ceres and there are several blocks. Cancelled when asked to
/// stop.
[[nodiscard]] absl::StatusOr<AdjustedBlocks> AdjustBlocks(std::vector<WorldBlock> blocks,
                                                          const GlobalAdjustOptions& options,
                                                          const BundleOptions& bundle,
                                                          const StageContext& context);

}  // namespace orbweave
