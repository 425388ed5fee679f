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
    visit("max_triplet_deg",
          self.max_triplet_deg,
          "rotation error round a triangle of pairs",
          Range{0.01, 180});
    visit("min_closing_share",
          self.min_closing_share,
          "edges of which fewer triangles close are dropped",
          Range{0, 1});
  }
};

struct FilteredViewGraph {
  ViewGraph graph{};
  std::vector<DroppedEdge> dropped{};
};

/// The view graph without edges that contradict their triangles in rotation.
///
/// A triangle (a, b, c) closes when the rotation c_from_a^-1 c_from_b b_from_a is at most
/// max_triplet_deg. Edges leave one at a time, the one with the smallest share of closing triangles
/// first (then most open triangles, fewest inliers, smallest pair), and the counts of its
/// triangles' other sides are renewed, so that one wrong edge does not take its neighbours along.
/// Edges in no triangle stay; an edge that leaves is the third side of a triangle whose other two
/// stay at that time, hence connected images remain connected. Edges without a geometry and
/// repetitions of a pair (all but the one with most inliers) leave first. Zach, Klopschitz,
/// Pollefeys: Disambiguating visual relations using loop constraints, CVPR 2010, is the idea; the
/// greedy order is ours.
[[nodiscard]] FilteredViewGraph BuildViewGraph(uint32_t num_images,
                                               std::vector<ViewEdge> edges,
                                               const ViewGraphOptions& options);

}  // namespace orbweave
