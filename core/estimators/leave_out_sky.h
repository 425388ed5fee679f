// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/estimators/matched_bearings.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Clouds drift by half a degree a second, all alike: they outvote the scene, or draw its pose
/// along. Sky may be what is high in either panorama (IsEitherHigh) and, under a pose, moves as
/// little as clouds do in the ten seconds that neighbours are apart at most.
[[nodiscard]] bool MayBeSky(const MatchedBearings& bearings,
                            const FeatureMatch& match,
                            const TwoViewGeometry& geometry);

/// Inliers of a geometry that are high up and too far away for the houses around, sorted; of a pure
/// rotation, where nothing has a depth, all that are high.
[[nodiscard]] std::vector<FeatureMatch> SkyOf(const MatchedBearings& bearings,
                                              const TwoViewGeometry& geometry);

/// A geometry without what is far and high where that moves (WithoutSky), its pose that of what is
/// below alone. It stands still, as towers do, and the geometry stays as it is, where nearly all of
/// what may be sky agrees with that pose, as clouds that drift off most epipolar planes do not, and
/// has not turned, be it by less than the error that agreeing allows (MeasureSkyDrift). It stays as
/// well where a tenth of the inliers at most is sky, or fewer than `min_inliers` are left.
/// `putative`: the matches of which it was found.
[[nodiscard]] TwoViewGeometry LeaveOutSky(const MatchedBearings& bearings,
                                          TwoViewGeometry geometry,
                                          std::span<const FeatureMatch> putative,
                                          int min_inliers);

}  // namespace orbweave
