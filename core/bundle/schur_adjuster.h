// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"

namespace orbweave {

/// AdjustBundle by Levenberg-Marquardt made for panoramas: points are eliminated in fixed chunks,
/// the system of the poses is factorised by BlockCholesky (never conjugate gradients: the bending
/// modes of a street converge too slowly). Robust losses by iteratively reweighted least squares.
/// Damping after Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05; steps are
/// accepted on the true cost. `problem` is valid.
[[nodiscard]] absl::StatusOr<BundleReport> AdjustBundleWithSchur(BundleProblem& problem,
                                                                 const BundleOptions& options,
                                                                 const StageContext& context);

}  // namespace orbweave
