// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"

namespace orbweave {

/// AdjustBundle with Ceres: independent of our own solver down to the residual, which here is the
/// 2-vector r = theta / sin(theta) B^T u in the tangent plane B of the observed bearing, with its
/// analytic Jacobian. The oracle of tests and an option for users. `problem` is valid.
[[nodiscard]] absl::StatusOr<BundleReport> AdjustBundleWithCeres(BundleProblem& problem,
                                                                 const BundleOptions& options,
                                                                 const StageContext& context);

}  // namespace orbweave
