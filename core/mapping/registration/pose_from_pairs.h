// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/pair_witness.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {

/// A pose that verified pairs with registered images propose, and what speaks for it.
struct PoseFromPairs {
  Rigid3 cam_from_world{};
  PoseSupport points{};           ///< scene points that agree
  uint32_t num_matches = 0;       ///< of pairs with registered images
  uint32_t agreeing_matches = 0;  ///< of those, near their epipolar planes and in front of both
  /// Matches that agree beyond those that would at half or twice the length of the baseline.
  uint32_t telling_matches = 0;
  /// Evidence for the length of the baseline: log10 of how many lengths would agree by chance with
  /// as many points that do not agree with half or twice the length too.
  double log10_false_alarms = 0.0;
  /// Largest angle between the directions to two registered images with which half of the matches
  /// agree, at most 90 degrees; where it is not small the directions alone fix the centre.
  double crossing_angle_rad = 0.0;
};

/// The poses that the five strongest verified pairs with registered images propose: the rotation of
/// each, and the centre on its ray, at the length that one scene point tells or where the ray of
/// another pair crosses.
[[nodiscard]] std::vector<Rigid3> PosesOfPairs(const MappingState& state,
                                               ImageSlot image,
                                               const SceneCorrespondences& correspondences);

/// A pose where few scene points are seen, from 2D-2D and 2D-3D matches together. A verified pair
/// with a registered image gives the rotation and the direction d of the baseline; its length s
/// comes from one scene point P seen along v, (C_n + s d - P) x v = 0, or from a second pair, whose
/// ray crosses. All such poses (PosesOfPairs) are tried; that with which most rays agree, to points
/// and to images, is refined on all of them (MinimiseBetweenViews). `views` are those of
/// MatchesWithRegistered. nullopt: no pair with a registered image, or no agreement.
[[nodiscard]] std::optional<PoseFromPairs> EstimatePoseFromPairs(
    const MappingState& state,
    ImageSlot image,
    std::span<const ViewMatches> views,
    const SceneCorrespondences& correspondences,
    double max_error_rad);

/// Whether the pairs hold the pose: half of the matches agree with it, `min_matches` at least, and
/// either points give the length of the baseline with evidence, or two directions cross and half of
/// `min_matches` tell it.
[[nodiscard]] bool IsHeldByPairs(const PoseFromPairs& pose, uint32_t min_matches);

}  // namespace orbweave
