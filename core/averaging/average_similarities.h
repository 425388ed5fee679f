// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/averaging/similarity_graph.h"
#include "core/base/stage_context.h"
#include "core/geometry/sim3.h"

namespace orbweave {

struct AverageSimilaritiesOptions {
  double loss_scale = 3.0;  ///< of the Cauchy loss, in standard deviations of an edge
  double max_error = 8.0;   ///< edges off by more standard deviations are switched off
};

struct AveragedSimilarities {
  std::vector<Sim3> world_from_node{};
  std::vector<uint32_t> part{};    ///< per node: its connected part, numbered by smallest node
  std::vector<uint8_t> is_used{};  ///< per edge
  std::vector<double> error{};     ///< per edge: sqrt(r^T information r)
};

/// Node frames that agree best with all edges: minimises the sum of Cauchy(sqrt(r^T information r))
/// with r = coordinates of world_from_a^-1 world_from_b in the edge's chart, Levenberg-Marquardt on
/// the sparse normal equations. Closed loops thereby spread their error over all their edges.
///
/// Two starts: the maximum spanning tree by strength, and a loss that narrows from least squares to
/// its final scale (graduated non-convexity; Yang et al., RA-L 2020), which takes over when it
/// leaves fewer edges contradicted. Then, one at a time, the edge with the largest error above
/// `max_error` is switched off, provided that its ends stay connected, and the rest is solved
/// again. In a single loop nothing but strength tells which edge is wrong; with more loops the
/// majority does. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<AveragedSimilarities> AverageSimilarities(
    const SimilarityGraph& graph,
    const AverageSimilaritiesOptions& options,
    const StageContext& context);

}  // namespace orbweave
