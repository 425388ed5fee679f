// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mapping/correspondence_graph.h"

namespace orbweave {

/// How far a ray reaches as one match of it has it, in units of the pair's baseline: by the law of
/// sines sin(B) / sin(X), with the triangle's angles at the other camera and at the point.
struct RayDepth {
  Node node = 0;
  uint32_t pair = 0;  ///< position among the given pairs
  double log_depth = 0.0;
};

/// Those of both rays of all matches of `pairs` (indices into graph.pairs, none a pure rotation),
/// sorted by node, then by pair. Rays that meet under less than `min_angle_rad`, and rays towards
/// the baseline (sine below 0.05), say nothing of depth and are left out.
[[nodiscard]] std::vector<RayDepth> MeasureRayDepths(const ClusterProblem& problem,
                                                     const CorrespondenceGraph& graph,
                                                     std::span<const uint32_t> pairs,
                                                     double min_angle_rad);

}  // namespace orbweave
