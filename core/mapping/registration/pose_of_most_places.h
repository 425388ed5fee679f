// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/estimators/refine_between_views.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {

/// `found`, or the pose further or nearer along its baselines with which points in more places of
/// the image agree. A place is a cell of SphereSpread. On one facade whose windows repeat, hundreds
/// of points agree with a camera that stands a whole window off, and outvote the few of each of all
/// other places; but they are one witness.
///
/// Tried are, for each of the strongest five of `views` (in that order), the steps C_v + s d along
/// the direction d from that view to the centre found, R held, with the lengths s that points tell
/// (BaselineLength). That of most places is refined with the points that agree. As many places as
/// `found` has are not enough: where nothing repeats, the pose found stays as it is, bit for bit.
[[nodiscard]] Rigid3 PoseOfMostPlaces(const Rigid3& found,
                                      const SceneCorrespondences& correspondences,
                                      std::span<const ViewMatches> views,
                                      double max_error_rad);

/// Places that hold a point, and those of them where one agrees with the pose.
struct PlaceCount {
  size_t seen = 0;
  size_t agreeing = 0;
};

[[nodiscard]] PlaceCount CountPlaces(const Rigid3& pose,
                                     const SceneCorrespondences& correspondences,
                                     double max_error_rad);

/// Of `candidates` the one with which points in most places agree, refined with these; nullopt
/// without candidates.
[[nodiscard]] std::optional<Rigid3> CandidateOfMostPlaces(
    std::span<const Rigid3> candidates,
    const SceneCorrespondences& correspondences,
    double max_error_rad);

/// Whether more places agree with `x` alone than with `y` alone, by more than two standard
/// deviations of a fair coin for each.
[[nodiscard]] bool HasClearlyMorePlaces(const Rigid3& x,
                                        const Rigid3& y,
                                        const SceneCorrespondences& correspondences,
                                        double max_error_rad);

}  // namespace orbweave
