// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/partitioned_ba/global_options.h"
#include "core/partitioned_ba/subproblem.h"
#include "core/partitioned_ba/subproblem_solver.h"

namespace orbweave {

struct AdjustedSubproblems {
  std::vector<Subproblem> subproblems{};
  std::vector<SubproblemSummary> summaries{};  ///< per subproblem
  GlobalAdjustReport report{};                 ///< without what FinaliseAdjustment finds
};

/// Adjusts and filters the subproblems of one world in this process, on `context.num_threads`
/// threads: StartWorld, AdvanceWorld and SubproblemSolver as they are when subproblems are spread
/// over many. InvalidArgument: bundle.solver is Ceres and there are several subproblems. Cancelled
/// when asked to stop.
[[nodiscard]] absl::StatusOr<AdjustedSubproblems> AdjustSubproblems(
    std::vector<Subproblem> subproblems,
    const GlobalAdjustOptions& options,
    const BundleOptions& bundle,
    const StageContext& context);

}  // namespace orbweave
