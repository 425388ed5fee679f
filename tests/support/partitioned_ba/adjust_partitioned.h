// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"

namespace orbweave {

/// Levenberg-Marquardt over subproblems that meet in separators only.
struct PartitionedReport {
  BundleReport bundle{};
  std::vector<double> accepted_costs{};  ///< the initial one first
  std::vector<uint32_t> separators_of_subproblem{};
  std::vector<size_t> message_bytes_of_subproblem{};  ///< of its system, per step
  size_t largest_node_bytes = 0;                      ///< of a sum's remaining system, per step
};

/// AdjustBundle with the same path of steps to rounding, computed subproblem by subproblem: every
/// subproblem is linearised on its own, the systems of their separators are added along a fixed
/// tree (MakeSeparatorTree), steps come back the same way. Subproblems run on `context.num_threads`
/// threads; same bytes for any number of them. Errors as AdjustBundle; InvalidArgument also for no
/// subproblems or an owner that is not below `num_subproblems`.
[[nodiscard]] absl::StatusOr<PartitionedReport> AdjustPartitioned(
    BundleProblem& problem,
    const std::vector<uint32_t>& owner_of_pose,
    uint32_t num_subproblems,
    const BundleOptions& options,
    const StageContext& context);

}  // namespace orbweave
