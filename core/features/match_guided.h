// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/match_options.h"
#include "core/geometry/rigid3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

/// Matches among features whose bearings lie within `max_error_rad` of each other's epipolar plane
/// under b_from_a and in front of both spheres: the nearest by descriptor among those candidates,
/// by `guided_max_ratio`, `max_distance` and cross check. There are few candidates in a plane, so
/// an unmatched feature easily finds one by chance: the ratio is what keeps such matches out.
/// Sorted by (a, b), one-to-one. Empty without a translation (no epipolar planes) or without
/// descriptors.
[[nodiscard]] std::vector<FeatureMatch> MatchGuided(const Features& a,
                                                    const Features& b,
                                                    const Rigid3& b_from_a,
                                                    double max_error_rad,
                                                    const MatchOptions& options);

}  // namespace orbweave
