// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/graph/adjacency.h"

namespace orbweave {

/// Images that two adjacent parts lend each other.
struct LentImages {
  uint32_t part_a = 0;  ///< < part_b
  uint32_t part_b = 0;
  std::vector<uint32_t> lent_to_a{};  ///< interior of b, sorted
  std::vector<uint32_t> lent_to_b{};  ///< interior of a, sorted
};

/// How many images two adjacent parts are to share at each place where they meet.
struct OverlapTargets {
  size_t usual = 0;
  std::map<std::pair<uint32_t, uint32_t>, size_t> of_parts{};  ///< (a < b): where not as usual

  [[nodiscard]] size_t Of(const std::pair<uint32_t, uint32_t>& parts) const {
    const auto found = of_parts.find(parts);
    return found == of_parts.end() ? usual : found->second;
  }
};

/// For every two parts joined by an edge the images to share, sorted by (part_a, part_b). At every
/// place where they meet (FindMeetingPlaces) both sides lend in turn the image with the largest
/// total edge weight into the other part there and the images lent to it before (ties: smallest
/// image), until as many are shared as `targets` says or neither side has a connected image left: a
/// similarity between two parts holds them together where they share images, and bends them where
/// they meet and share none. `part_of`: per image; images without an edge may hold anything. Places
/// are independent of each other; a larger target lends the images of a smaller one and more.
[[nodiscard]] std::vector<LentImages> GrowOverlap(const Adjacency& adjacency,
                                                  std::span<const double> edge_weight,
                                                  std::span<const uint32_t> part_of,
                                                  const OverlapTargets& targets);

}  // namespace orbweave
