// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/adjust_bundle.h"

#include "core/bundle/ceres_adjuster.h"
#include "core/bundle/schur_adjuster.h"

namespace orbweave {
absl::StatusOr<BundleReport> AdjustBundle(BundleProblem& problem,
                                          const BundleOptions& options,
                                          const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(ValidateBundleProblem(problem));
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  switch (options.solver) {
    case BundleSolver::kCeres:
      return AdjustBundleWithCeres(problem, options, context);
    case BundleSolver::kSchur:
      break;
  }
  return AdjustBundleWithSchur(problem, options, context);
}

}  // namespace orbweave
