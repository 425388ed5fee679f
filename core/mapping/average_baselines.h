// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/mapping/correspondence_graph.h"

namespace orbweave {

/// Lengths s of pairs' baselines in one common unit. By the law of sines a match gives its rays
/// their depths in units of the pair's baseline, d_a = sin(B) / sin(X) with the triangle's angles
/// at camera b and at the point. A ray of an image that is matched in two pairs p and q has one
/// depth,
///
///   s_p d_p = s_q d_q      i.e.      log s_q - log s_p = log d_p - log d_q,
///
/// of which the median over the rays that both pairs share is taken, then AverageDifferences over
/// all pairs of pairs. Directions alone would leave the steps of a straight street open; depths do
/// not. `pairs`: indices into graph.pairs, none a pure rotation. `min_angle_rad`: matches whose
/// rays meet under less say nothing of depth. Returns a length per pair; 0 for those that no shared
/// rays join with the most. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::vector<double>> AverageBaselines(const ClusterProblem& problem,
                                                                   const CorrespondenceGraph& graph,
                                                                   std::span<const uint32_t> pairs,
                                                                   double min_angle_rad,
                                                                   const StageContext& context);

}  // namespace orbweave
