// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/mapping/model/cluster_problem.h"

namespace orbweave {

/// A cluster as it was seen by who drives along.
struct SceneAlone {
  ClusterProblem problem{};
  std::vector<ImagePair> pairs_of_carrier{};  ///< that it lacks, sorted
};

/// The cluster without matches of what goes along with the camera: the edge of a windscreen, a roof
/// rack, a mark that a program wrote into every panorama. Where the street goes straight they fit a
/// pose that has not turned, as if they were far away, and may be most of what a pair of distant
/// panoramas has in common, which then contradicts all others: beside a mask that leaves the edge
/// of a dashboard free, 331 matches of which nearly all were that edge, between panoramas 37 m
/// apart.
///
/// A pair of one drive is unturned where its rotation is no more than `max_error_px`, and a match
/// of it is fixed where its rays are no further apart. Positions tell what fixed matches show: of
/// panoramas so far apart that it would lie two kilometres away, which streets do not see, and
/// further than four of their sigmas. Cells of the sphere (SphereCell, 64 x 64) with fixed matches
/// of three such pairs of a drive hold its carrier. Fixed matches there are left out of all
/// unturned pairs of the drive, and so are pairs of which less than half is left: what goes on
/// agreeing with a pose that the carrier made is no evidence for it. Angles and spread of a pair
/// stay those with its carrier, which are small: models that began with such pairs fell to pieces.
/// nullopt where no cell holds a carrier.
[[nodiscard]] std::optional<SceneAlone> LeaveOutCarrier(const ClusterProblem& problem,
                                                        double max_error_px);

}  // namespace orbweave
