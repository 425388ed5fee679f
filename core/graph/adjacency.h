// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// The edges of a view graph seen from its images, in one flat array.
class Adjacency {
 public:
  /// The other end of an edge, and the edge's position in the list it came from.
  struct Link {
    uint32_t image = 0;
    uint32_t edge = 0;
  };

  /// `edges`: a < b < num_images, without repetition, in any order.
  Adjacency(uint32_t num_images, std::span<const ViewEdge> edges);

  [[nodiscard]] uint32_t num_images() const { return static_cast<uint32_t>(begin_.size() - 1); }
  /// Links of an image, sorted by the other image.
  [[nodiscard]] std::span<const Link> Of(uint32_t image) const {
    return {links_.data() + begin_[image], links_.data() + begin_[image + 1]};
  }

 private:
  std::vector<size_t> begin_;
  std::vector<Link> links_;
};

/// Calls visit(image, edge1, edge2) for every image joined to both lists, in image order.
template <typename Visitor>
void ForEachCommonLink(std::span<const Adjacency::Link> links1,
                       std::span<const Adjacency::Link> links2,
                       Visitor&& visit) {
  size_t i = 0;
  size_t j = 0;
  while (i < links1.size() && j < links2.size()) {
    if (links1[i].image < links2[j].image) {
      ++i;
    } else if (links2[j].image < links1[i].image) {
      ++j;
    } else {
      visit(links1[i].image, links1[i].edge, links2[j].edge);
      ++i;
      ++j;
    }
  }
}

}  // namespace orbweave
