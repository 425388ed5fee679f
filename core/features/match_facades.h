// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/accept_matches.h"
#include "core/features/match_options.h"
#include "core/features/pair_side.h"

namespace orbweave {

/// Matches of the features of facade views of two panoramas (FacadeView), as AcceptNearest would
/// have them within each view: view k of a is compared with view k + turn of b, for that turn of
/// eight of which the largest features of all views have most in common. Neighbouring views show
/// the same: of matches at one place of both panoramas, that is within `same_rad`, the first one is
/// kept. Sorted by (a, b), of the indices of all features, rated within their views. Empty where
/// either has no such features.
[[nodiscard]] std::vector<RatedMatch> MatchFacades(const PairSide& a,
                                                   const PairSide& b,
                                                   double same_rad,
                                                   const MatchOptions& options);

}  // namespace orbweave
