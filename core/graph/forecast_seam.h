// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/graph/adjacency.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What pairs say, before anything is reconstructed, about the similarity that a seam will give.
struct SeamForecast {
  /// Shared images that both clusters will register: they are interior to it or, taken one after
  /// another, have pairs of 60 inliers in all with its interior and shared images before them.
  uint32_t firm = 0;
  uint32_t shared = 0;
  /// Of rotation and scale, from the pairs of firm images: an inlier tells the rotation as well as
  /// bearings are, and the scale sin(a) times as well, a the angle between its rays; hence
  /// sum(n) / sum(n sin^2 a) over pairs of n inliers. Infinite where no pair has depth.
  double condition = 0.0;
};

/// `clusters` are those of the seam. Edges of `graph` as in `adjacency`.
[[nodiscard]] SeamForecast ForecastSeam(const ViewGraph& graph,
                                        const Adjacency& adjacency,
                                        const Seam& seam,
                                        const Cluster& cluster_a,
                                        const Cluster& cluster_b);

/// Why a seam is not likely to hold: fewer than three firm images, of which two would leave their
/// common line free to turn, or a condition above `max_condition`. Empty: it should hold.
[[nodiscard]] std::string WeaknessOf(const SeamForecast& forecast, double max_condition);

}  // namespace orbweave
