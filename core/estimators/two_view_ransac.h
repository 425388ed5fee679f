// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/base/stage_context.h"
#include "core/estimators/bearing_pairs.h"
#include "core/estimators/two_view_hints.h"
#include "core/estimators/two_view_options.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// RANSAC with local optimisation over the minimal solver of `options`: a pose, |T| = 1, of the
/// essential matrix with the least truncated cost, any of its four (see ResolveCheirality). nullopt
/// when there are fewer pairs than a sample or no sample has a solution. Cancelled when asked to
/// stop. `hints` of the matches that `pairs` were arranged from: the best first are tried first
/// (SampleSource); with a predicted rotation the solver is that of two matches.
[[nodiscard]] absl::StatusOr<std::optional<Rigid3>> FindRelativePose(const BearingPairs& pairs,
                                                                     const TwoViewHints& hints,
                                                                     double max_error_rad,
                                                                     const TwoViewOptions& options,
                                                                     const StageContext& context);

}  // namespace orbweave
