// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <set>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

inline ViewEdge Edge(uint32_t a, uint32_t b, uint32_t num_inliers = 100) {
  return {.pair = MakePair(ImageId(a), ImageId(b)),
          .num_inliers = num_inliers,
          .median_angle_rad = 0.2,
          .spread = 0.5};
}

inline std::set<ImagePair> PairsOf(const std::vector<DroppedEdge>& edges) {
  std::set<ImagePair> pairs;
  for (const DroppedEdge& edge : edges) pairs.insert(edge.pair);
  return pairs;
}

/// A drive: every image is joined to the `window` following ones, the nearer the stronger.
inline ViewGraph Street(uint32_t num_images, uint32_t window) {
  ViewGraph graph{.num_images = num_images};
  for (uint32_t a = 0; a < num_images; ++a) {
    for (uint32_t b = a + 1; b <= a + window && b < num_images; ++b) {
      graph.edges.push_back(Edge(a, b, 600 / (b - a)));
    }
  }
  return graph;
}

/// A drive round a block whose end meets its beginning.
inline ViewGraph Loop(uint32_t num_images, uint32_t window) {
  ViewGraph graph{.num_images = num_images};
  for (uint32_t a = 0; a < num_images; ++a) {
    for (uint32_t step = 1; step <= window; ++step) {
      graph.edges.push_back(Edge(a, (a + step) % num_images, 600 / step));
    }
  }
  return graph;
}

/// Streets crossing: a square grid of images, each joined to its right and lower neighbour.
inline ViewGraph Grid(uint32_t side) {
  ViewGraph graph{.num_images = side * side};
  for (uint32_t row = 0; row < side; ++row) {
    for (uint32_t column = 0; column < side; ++column) {
      const uint32_t i = row * side + column;
      if (column + 1 < side) graph.edges.push_back(Edge(i, i + 1));
      if (row + 1 < side) graph.edges.push_back(Edge(i, i + side));
    }
  }
  return graph;
}

}  // namespace orbweave
