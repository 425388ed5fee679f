// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/merging/checks/image_support.h"
#include "core/merging/checks/place_by_sides.h"
#include "core/merging/checks/seen_between.h"
#include "core/merging/checks/track_correlation.h"
#include "core/partitioned_ba/separator_system.h"
#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// Damping of points where nothing else holds their depth: just above rounding, so that one seen
/// once stays free and holds no world.
inline constexpr double kUnheldPointDamping = 1e-14;

/// What an adjusted subproblem has to say about its world as a whole, its points eliminated: it
/// grows with the subproblem's panoramas.
struct SubproblemInspection {
  /// Normal equations of all its bearings, least squares, each bearing weighted by the scatter
  /// found in its panorama; variables: poses that see something, split points.
  SeparatorSystem bearings{};
  double sum_of_squares = 0.0;           ///< of bearings' errors over their sigmas
  double weighted_sum_of_squares = 0.0;  ///< the same with those weights
  double redundancy = 0.0;               ///< equations less the unknowns of eliminated points
  std::optional<ImageId> held{};
  std::optional<ImageId> farthest{};
  std::vector<SidePlacement> placements{};
  std::vector<PatchSupport> supports{};         ///< SupportOf
  TrackCorrelation correlation{};               ///< of tracks that this subproblem has for itself
  std::vector<Eigen::Vector3d> points_about{};  ///< PointsAboutPanoramas
  std::vector<SeenBetween> seen_between{};      ///< CountSeenBetween
};

/// For AssessWorld and SeamCertifier. Same bytes for any `num_threads`.
[[nodiscard]] SubproblemInspection InspectSubproblem(const Subproblem& subproblem, int num_threads);

}  // namespace orbweave
