// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct ViewGraphOptions {
  double max_triplet_deg = 3.0;
  double min_closing_share = 0.3;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_triplet_deg", self.max_triplet_deg, "rotation error round a triangle of pairs", Range{0.01, 180});
    visit("min_closing_share", self.min_closing_share, "edges of which fewer triangles close are dropped", Range{0, 1});
  }
};

struct FilteredViewGraph {
  ViewGraph graph{};
  std::vector<DroppedEdge> dropped{};
};

/// The view graph without edges that contradict their triangles in rotation. Edges in no triangle stay.
[[nodiscard]] FilteredViewGraph BuildViewGraph(uint32_t num_images, std::vector<ViewEdge> edges, const ViewGraphOptions& options);

}  // namespace orbweave
