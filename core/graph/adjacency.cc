// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/adjacency.h"

#include <algorithm>

#include "core/base/status.h"

namespace orbweave {

Adjacency::Adjacency(uint32_t num_images, std::span<const ViewEdge> edges)
    : begin_(num_images + 1, 0), links_(2 * edges.size()) {
  for (const ViewEdge& edge : edges) {
    ORBWEAVE_CHECK(edge.pair.a < edge.pair.b && edge.pair.b.value < num_images);
    ++begin_[edge.pair.a.value + 1];
    ++begin_[edge.pair.b.value + 1];
  }
  for (uint32_t i = 0; i < num_images; ++i) begin_[i + 1] += begin_[i];

  std::vector<size_t> next(begin_.begin(), begin_.end() - 1);
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const uint32_t a = edges[e].pair.a.value;
    const uint32_t b = edges[e].pair.b.value;
    links_[next[a]++] = {b, e};
    links_[next[b]++] = {a, e};
  }
  for (uint32_t i = 0; i < num_images; ++i) {
    std::sort(links_.begin() + static_cast<ptrdiff_t>(begin_[i]),
              links_.begin() + static_cast<ptrdiff_t>(begin_[i + 1]),
              [](const Link& x, const Link& y) { return x.image < y.image; });
  }
}

}  // namespace orbweave
