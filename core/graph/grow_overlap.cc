// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/grow_overlap.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orbweave {
namespace {

// Images of one part with their weight into the other part and what was lent to it.
class Lender {
 public:
  void AddWeight(uint32_t image, double weight) { candidates_[image] += weight; }

  [[nodiscard]] bool IsExhausted() const { return candidates_.empty(); }
  [[nodiscard]] const std::vector<uint32_t>& lent() const { return lent_; }

  // Lends the strongest candidate; its neighbours within the part become candidates.
  void LendOne(const Adjacency& adjacency,
               std::span<const double> edge_weight,
               std::span<const uint32_t> part_of) {
    const auto strongest =
        std::max_element(candidates_.begin(), candidates_.end(), [](const auto& x, const auto& y) {
          return x.second < y.second;
        });
    const uint32_t image = strongest->first;
    candidates_.erase(strongest);
    lent_.insert(std::upper_bound(lent_.begin(), lent_.end(), image), image);
    for (const Adjacency::Link& link : adjacency.Of(image)) {
      if (part_of[link.image] != part_of[image]) continue;
      if (std::binary_search(lent_.begin(), lent_.end(), link.image)) continue;
      AddWeight(link.image, edge_weight[link.edge]);
    }
  }

 private:
  std::map<uint32_t, double> candidates_;
  std::vector<uint32_t> lent_;
};

struct SeamLenders {
  Lender a{};
  Lender b{};
};

using Seams = std::map<std::pair<uint32_t, uint32_t>, SeamLenders>;

Seams FindSeams(const Adjacency& adjacency,
                std::span<const double> edge_weight,
                std::span<const uint32_t> part_of) {
  Seams seams;
  for (uint32_t image = 0; image < adjacency.num_images(); ++image) {
    for (const Adjacency::Link& link : adjacency.Of(image)) {
      if (part_of[image] >= part_of[link.image])
        continue;  // each cut edge once, from its lower part
      SeamLenders& seam = seams[{part_of[image], part_of[link.image]}];
      seam.a.AddWeight(image, edge_weight[link.edge]);
      seam.b.AddWeight(link.image, edge_weight[link.edge]);
    }
  }
  return seams;
}

}  // namespace

std::vector<LentImages> GrowOverlap(const Adjacency& adjacency,
                                    std::span<const double> edge_weight,
                                    std::span<const uint32_t> part_of,
                                    const OverlapTargets& targets) {
  std::vector<LentImages> shared;
  for (auto& [parts, seam] : FindSeams(adjacency, edge_weight, part_of)) {
    const size_t target = targets.Of(parts);
    while (seam.a.lent().size() + seam.b.lent().size() < target) {
      if (seam.a.IsExhausted() && seam.b.IsExhausted()) break;
      const bool a_lends = seam.b.IsExhausted() ||
                           (!seam.a.IsExhausted() && seam.a.lent().size() <= seam.b.lent().size());
      (a_lends ? seam.a : seam.b).LendOne(adjacency, edge_weight, part_of);
    }
    shared.push_back({.part_a = parts.first,
                      .part_b = parts.second,
                      .lent_to_a = seam.b.lent(),
                      .lent_to_b = seam.a.lent()});
  }
  return shared;
}

}  // namespace orbweave
