// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/base/stage_context.h"
#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/positioning/place_by_pairs.h"

namespace orbweave {

/// Poses of all images at once from their positions and the directions of pairs. Where houses
/// repeat, rays tell the length of a step a house too long or too short, and so many of them that
/// no count of rays finds it out; in which direction a step leads they all tell, as what lies along
/// a facade is seen in the same direction a house further on. So lengths are left to GNSS here,
/// and to the rays once all images stand within a few metres.
///
/// Rotations as in PlaceByPairs, turned to east, north and up by the directions between positions
/// (EnuFromDisplacements). Then centres C that minimise, with weights 1 / (1 + e^2 / 9)^2 of their
/// errors e in sigmas (Geman and McClure 1987), reweighted,
///
///   |C_i - G_i|^2               horizontally, and vertically from an origin of each drive; sigmas
///                               as stated, times what positions prove to be worth, two at least;
///   |(I - u u^T)(C_b - C_a)|^2  with the direction u from a to b; sigma a degree and 0.1 m, and at
///                               first as much as positions are off;
///   (u^T (C_b - C_a) - l)^2     of steps, with the length l of those about; sigma 0.3 l.
///
/// Directions that lie elsewhere than two positions by three of their sigmas take no part; a
/// position that most of its directions contradict says nothing at first (SightsBesidePositions).
///
/// Good to a metre or two of GNSS with three metres: a start for an adjustment. Holds the largest
/// set of `available` images that directions join; empty where positions do not tell where they are
/// (DoPositionsSpread), or less than 70 % of them agree. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<PairPlacement> PlaceByPositions(const ClusterProblem& problem,
                                                             const CorrespondenceGraph& graph,
                                                             std::span<const uint8_t> available,
                                                             const MappingOptions& options,
                                                             const StageContext& context);

}  // namespace orbweave
