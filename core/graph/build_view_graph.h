// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct ViewGraphOptions {
  double max_triplet_deg = 3.0;
  double min_closing_share = 0.5;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_triplet_deg",
          self.max_triplet_deg,
          "rotation error round a triangle of pairs",
          Range{0.01, 180});
    visit("min_closing_share",
          self.min_closing_share,
          "edges for which no more of the evidence of their triangles speaks are dropped",
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
/// max_triplet_deg. What it says of an edge weighs as much as the weaker of its other two sides,
///   share(e) = (w_e + sum_closing m_t) / (w_e + sum_all m_t),  m_t = min of w over the other
///   sides, w = spread sqrt(inliers):
/// matches of one place are not independent, and many of few places may be those of a vehicle or of
/// a facade that repeats. Two pairs of a taxi that drove along, 60 and 79 inliers on a third of the
/// sphere, agree with each other and with nothing else, and do not outvote the pair of 221 that
/// both contradict; nor does a wrong pair of 509 outvote two of 346 and 153. Edges in open
/// triangles whose share is no more than min_closing_share leave one at a time, the smallest share
/// first (then fewest inliers, smallest pair), and the triangles of the other sides are weighed
/// anew, so that one wrong edge does not take its neighbours along. Edges in no triangle stay; an
/// edge that leaves is the third side of a triangle whose other two stay at that time, hence
/// connected images remain connected. Edges without a geometry and repetitions of a pair (all but
/// the one with most inliers) leave first. Zach, Klopschitz, Pollefeys: Disambiguating visual
/// relations using loop constraints, CVPR 2010, is the idea; weights and the greedy order are ours.
[[nodiscard]] FilteredViewGraph BuildViewGraph(uint32_t num_images,
                                               std::vector<ViewEdge> edges,
                                               const ViewGraphOptions& options);

}  // namespace orbweave
