// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/mapping_options.h"

namespace orbweave {

/// Pairs to start from, best first, as indices into graph.pairs: the paper's section 4 relaxed step
/// by step. A pair of at least options.seed_min_inliers matches and a median angle of at least
/// options.seed_min_angle_deg is of level 0; every halving of either that it needs costs a level,
/// being nearly planar costs four. Lower levels come first; within a level more matches that show
/// depth, that is, whose rays meet under options.min_angle_deg at least. Left out: pure rotations,
/// pairs of fewer than options.min_inliers such matches, and pairs with an image that is not
/// `available`. The preset `paper` takes its section 4 as printed: the image with most matches, of
/// its pairs the one with most matches that has *more* than the two limits, then the next image;
/// planes count as other pairs do. Only where no pair satisfies the limits, about which the paper
/// says nothing, they are halved.
[[nodiscard]] std::vector<uint32_t> FindSeedPairs(const ClusterProblem& problem,
                                                  const CorrespondenceGraph& graph,
                                                  std::span<const uint8_t> available,
                                                  const MappingOptions& options);

}  // namespace orbweave
