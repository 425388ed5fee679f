// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/averaging/similarity_chart.h"

namespace orbweave {

/// A measured similarity between two nodes.
struct SimilarityEdge {
  uint32_t a = 0;
  uint32_t b = 0;
  SimilarityChart measured{};                   ///< chart.a_from_b is the measurement
  Matrix7d information = Matrix7d::Identity();  ///< inverse covariance in its coordinates
  double strength = 1.0;  ///< which edges to believe first, e.g. a number of inliers
  /// Whether it holds parts of the graph together, and may be switched off. One that does not says
  /// of two nodes of a part what other edges leave open, such as which way is up in both.
  bool joins = true;
  /// SimilaritySolver: counts by least squares, whatever the loss of the other edges.
  bool is_certain = false;
};

struct SimilarityGraph {
  std::vector<double> node_length{};  ///< per node: extent of its data in its own units, > 0
  std::vector<double>
      node_weight{};  ///< per node: the heaviest of a connected part is its world frame
  std::vector<SimilarityEdge> edges{};
};

}  // namespace orbweave
