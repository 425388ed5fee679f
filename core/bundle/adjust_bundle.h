// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_report.h"

namespace orbweave {

/// Minimises 1/2 sum rho(theta^2 / sigma^2) over poses and points, plus priors, by
/// Levenberg-Marquardt; theta is the angle between the predicted ray and the observed bearing. The
/// residual is the logarithm of the ray in the tangent plane of the bearing, which has theta as its
/// length and is as large behind the bearing as it should be; with options.residual erp_px it is
/// the difference in the equirectangular image instead (EvaluateErpResidual). Each pose is one
/// 6-dof block (R, C). Where neither fixed poses or points nor priors hold the gauge, the first
/// pose and the distance to the farthest other centre are held.
///
/// A pose or point without observations stays where it is. Same bytes for any
/// `context.num_threads`. InvalidArgument: an index out of range or a sigma that is not positive.
/// Cancelled when asked to stop (the problem then holds the last accepted step).
[[nodiscard]] absl::StatusOr<BundleReport> AdjustBundle(BundleProblem& problem,
                                                        const BundleOptions& options,
                                                        const StageContext& context);

}  // namespace orbweave
