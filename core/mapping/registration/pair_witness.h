// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/estimators/refine_between_views.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/scene_correspondences.h"

namespace orbweave {

/// Relative poses are less exact than adjusted ones: what pairs say of a pose that is not refined
/// is judged at this many thresholds.
inline constexpr double kPairSlack = 3.0;
/// The matches of a pair that agrees. Wrong matches agree with a pose by 1 in 100 only.
inline constexpr double kAgreeingPairShare = 0.5;
/// So many points or matches tell how long a step is.
inline constexpr uint32_t kFewestTelling = 4;

/// The verified pairs of `image` with registered images, strongest first; indices of the graph's.
[[nodiscard]] std::vector<uint32_t> PairsWithRegistered(const MappingState& state, ImageSlot image);

/// Their matches, but for those of pure rotations, which have no epipolar planes.
[[nodiscard]] std::vector<ViewMatches> MatchesWithRegistered(const MappingState& state,
                                                             ImageSlot image);

/// Matches that agree with the pose: near their epipolar planes, and in front of both or far.
[[nodiscard]] uint32_t CountAgreeingMatches(const Rigid3& cam_from_world,
                                            std::span<const ViewMatches> views,
                                            double max_error_rad);

/// Whether a strong pair speaks against the pose: one with half as many matches as the strongest or
/// more, and of those that show parallax, a tenth or more of them all, fewer than half agree.
/// Windows that repeat let an image see points a whole window further on, more of them than where
/// it is; but two that stand next to each other see which of them is in front. A camera that stood
/// sees neither.
[[nodiscard]] bool ContradictsStrongPair(const Rigid3& cam_from_world,
                                         std::span<const ViewMatches> views,
                                         double max_error_rad);

/// What agrees with this distance from a neighbour beyond what would with half or twice of it: what
/// is far, or seen from that image alone, agrees with every distance.
struct Telling {
  uint32_t points = 0;
  uint32_t matches = 0;
};

[[nodiscard]] Telling CountTelling(const Rigid3& cam_from_world,
                                   const Eigen::Vector3d& neighbour_centre,
                                   const SceneCorrespondences& correspondences,
                                   std::span<const ViewMatches> views,
                                   double max_error_rad);

/// Whether points and matches tell how long the step from the image of the strongest pair is
/// (kFewestTelling). True without such a pair.
[[nodiscard]] bool IsLengthTold(const Rigid3& cam_from_world,
                                const SceneCorrespondences& correspondences,
                                std::span<const ViewMatches> views,
                                double max_error_rad);

}  // namespace orbweave
