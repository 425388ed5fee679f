// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/base/status.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct PartitionOptions {
  int cluster_size = 100;
  int min_clusters = 1;
  int overlap = 12;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("cluster_size", self.cluster_size, "panoramas per cluster before overlap; 0: one cluster", Range{0, 1000000});
    visit("min_clusters", self.min_clusters, "divide into at least this many clusters where the images suffice", Range{1, 100000});
    visit("overlap", self.overlap, "images shared at each seam, at least", Range{2, 1000});
  }
};

/// METIS k-way partition of each connected component of the view graph (edge weight = inliers x spread), overlap
/// grown seam by seam along the strongest edges. Images without an edge are in no cluster. Deterministic.
[[nodiscard]] absl::StatusOr<Partition> PartitionViewGraph(const ViewGraph& graph, const PartitionOptions& options);

}  // namespace orbweave
