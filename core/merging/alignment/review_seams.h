// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/graph/partition_view_graph.h"
#include "core/merging/alignment/alignment.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What reviews have asked of a partition so far.
struct PartitionReview {
  uint32_t rounds = 0;  ///< in which anybody asked
  std::vector<OverlapRequest>
      requests{};  ///< latest of each seam, sorted by (cluster_a, cluster_b)
};

/// Looks for seams that more overlap may mend. A seam is two clusters that lend each other images.
/// It asks when none of its submodels' similarities is used and well conditioned (at most
/// options.max_condition), though not when a loop contradicts one: that place is not seen too
/// little but differently. It also asks when one of its clusters fell apart: less than half of the
/// cluster's images are registered in submodels that share a world. A request doubles the overlap
/// of the seam, wherever its clusters meet, up to options.max_overlap; a seam that had no more to
/// lend the last time does not ask again, and nobody does after options.reviews rounds. Returned as
/// `before` when nobody asks.
[[nodiscard]] PartitionReview ReviewSeams(const Partition& partition,
                                          const Alignment& alignment,
                                          PartitionReview before,
                                          const PartitionOptions& options);

}  // namespace orbweave
