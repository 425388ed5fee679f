// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/grow_overlap.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "core/graph/meeting_places.h"

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

// The images to lend where two parts meet.
struct PlaceLenders {
  PlaceLenders(const MeetingPlace& place, std::span<const double> edge_weight) {
    for (const CutEdge& cut : place) {
      a.AddWeight(cut.in_a, edge_weight[cut.edge]);
      b.AddWeight(cut.in_b, edge_weight[cut.edge]);
    }
  }

  void Lend(size_t target,
            const Adjacency& adjacency,
            std::span<const double> edge_weight,
            std::span<const uint32_t> part_of) {
    while (a.lent().size() + b.lent().size() < target) {
      if (a.IsExhausted() && b.IsExhausted()) return;
      const bool a_lends =
          b.IsExhausted() || (!a.IsExhausted() && a.lent().size() <= b.lent().size());
      (a_lends ? a : b).LendOne(adjacency, edge_weight, part_of);
    }
  }

  Lender a{};
  Lender b{};
};

std::vector<uint32_t> United(const std::vector<uint32_t>& x, const std::vector<uint32_t>& y) {
  std::vector<uint32_t> images;
  std::ranges::set_union(x, y, std::back_inserter(images));
  return images;
}

}  // namespace

std::vector<LentImages> GrowOverlap(const Adjacency& adjacency,
                                    std::span<const double> edge_weight,
                                    std::span<const uint32_t> part_of,
                                    const OverlapTargets& targets) {
  std::vector<LentImages> shared;
  for (const auto& [parts, places] : FindMeetingPlaces(adjacency, edge_weight, part_of)) {
    LentImages& lent = shared.emplace_back(parts.first, parts.second);
    for (const MeetingPlace& place : places) {
      PlaceLenders lenders(place, edge_weight);
      lenders.Lend(targets.Of(parts), adjacency, edge_weight, part_of);
      lent.lent_to_a = United(lent.lent_to_a, lenders.b.lent());
      lent.lent_to_b = United(lent.lent_to_b, lenders.a.lent());
    }
  }
  return shared;
}

}  // namespace orbweave
