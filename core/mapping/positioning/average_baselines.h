// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/registration/gnss_steps.h"

namespace orbweave {

struct BaselineLengths {
  std::vector<double> lengths{};  ///< per pair; 0: unknown
  bool in_metres = false;         ///< else in a unit of their own
  double step_factor = 1.0;       ///< FactorOfSteps
};

/// Lengths s of pairs' baselines in one common unit. By the law of sines a match gives its rays
/// their depths in units of the pair's baseline, d_a = sin(B) / sin(X) with the triangle's angles
/// at camera b and at the point. A ray of an image that is matched in two pairs p and q has one
/// depth,
///
///   s_p d_p = s_q d_q      i.e.      log s_q - log s_p = log d_p - log d_q,
///
/// and so says each ray that both pairs share. Where windows repeat they say several things, each
/// true of some: what counts is where they lie closest (ShortestHalf), as exactly as they lie
/// there. Directions alone would leave the steps of a straight street open; depths do not.
///
/// `steps` (GnssSteps, or none) say how long some are in metres, as exactly as clear ratios bear
/// out (FactorOfSteps): they join what no rays do, and decide where rays are of two minds.
/// AverageDifferences over all of it.
///
/// `pairs`: indices into graph.pairs, none a pure rotation. `min_angle_rad`: matches whose rays
/// meet under less say nothing of depth. Unknown are lengths that neither rays nor steps join with
/// the most. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<BaselineLengths> AverageBaselines(const ClusterProblem& problem,
                                                               const CorrespondenceGraph& graph,
                                                               std::span<const uint32_t> pairs,
                                                               std::span<const GnssStep> steps,
                                                               double min_angle_rad,
                                                               const StageContext& context);

}  // namespace orbweave
