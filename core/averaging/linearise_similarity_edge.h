// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/averaging/similarity_chart.h"

namespace orbweave {

/// A node of a similarity graph: its frame in the world, and the length that makes its translation
/// step a number of order one.
struct SimilarityNode {
  Sim3 world_from_node{};
  double length_in_node = 1.0;
};

/// The node moved by x = (w, lambda, d) within its own frame: R Exp(w), s exp(lambda),
/// t + s R (length d).
[[nodiscard]] Sim3 MoveNode(const SimilarityNode& node, const Vector7d& x);

/// Residual r of a measured a_from_b, the coordinates of world_from_a^-1 world_from_b in its chart,
/// and its derivatives by the steps of MoveNode..
struct LinearisedSimilarityEdge {
  Vector7d r = Vector7d::Zero();
  Matrix7d J_a = Matrix7d::Zero();
  Matrix7d J_b = Matrix7d::Zero();
};

[[nodiscard]] LinearisedSimilarityEdge LineariseSimilarityEdge(const SimilarityChart& measured,
                                                               const SimilarityNode& a,
                                                               const SimilarityNode& b);

}  // namespace orbweave
