// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/gap_votes.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/quantile.h"
#include "core/mapping/matches_in_planes.h"
#include "core/mapping/ray_depths.h"
#include "core/mapping/registered_sequence.h"
#include "core/mapping/street_lines.h"

namespace orbweave {
namespace {

/// A pair of a ray, seen from the image of the ray.
struct Sight {
  uint32_t pair = 0;  ///< of those asked
  size_t other = 0;   ///< place of the other image
  double log_depth = 0.0;
};

class Collector {
 public:
  explicit Collector(const AskedRays& asked)
      : asked_(asked),
        places_(asked.state, kMatchTolerance * asked.max_error_px),
        votes_(places_.size()) {
    const std::vector<LinkedPair>& pairs = asked.state.Graph().pairs;
    for (uint32_t p = 0; p < pairs.size(); ++p) AddPair(p, pairs[p]);
  }

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    const ImageSlot own = asked_.state.Graph().image_of_node[depths.front().node];
    const std::vector<Sight> sights = SightsOf(own, depths);
    const size_t here = places_.PlaceOf(own);
    for (const Sight& sight : sights) {
      const auto [first, last] = std::minmax(here, sight.other);
      if (last - first > kReachAlongLine) continue;
      for (size_t gap = first; gap < last; ++gap) Ask(here, sight, gap, sights);
    }
  }

  /// Without those where a line ends.
  [[nodiscard]] std::vector<GapVotes> Take() {
    std::vector<GapVotes> gaps;
    for (size_t place = 0; place + 1 < places_.size(); ++place) {
      GapVotes& gap = votes_[place];
      gap.image = places_.At(place);
      gap.next = places_.At(place + 1);
      if (places_.LineOf(gap.image) == places_.LineOf(gap.next)) gaps.push_back(std::move(gap));
    }
    return gaps;
  }

 private:
  void AddPair(uint32_t index, const LinkedPair& pair) {
    const MappingState& state = asked_.state;
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) return;
    if (places_.LineOf(pair.a) != places_.LineOf(pair.b)) return;
    const auto [first, last] = std::minmax({places_.PlaceOf(pair.a), places_.PlaceOf(pair.b)});
    if (last - first > kReachAlongLine) return;
    for (size_t gap = first; gap < last; ++gap) votes_[gap].pairs.push_back(index);
  }

  /// Those with images of the same line.
  [[nodiscard]] std::vector<Sight> SightsOf(ImageSlot own, std::span<const RayDepth> depths) const {
    std::vector<Sight> sights;
    for (const RayDepth& depth : depths) {
      const LinkedPair& pair = asked_.state.Graph().pairs[asked_.pairs[depth.pair]];
      const ImageSlot other = pair.a == own ? pair.b : pair.a;
      if (places_.LineOf(other) == places_.LineOf(own))
        sights.push_back({depth.pair, places_.PlaceOf(other), depth.log_depth});
    }
    return sights;
  }

  /// What the pairs on this side of the gap say of one that leads across it.
  void Ask(size_t here, const Sight& across, size_t gap, std::span<const Sight> sights) {
    ++votes_[gap].asked;
    std::vector<double> reaches;
    for (const Sight& sight : sights) {
      if ((sight.other <= gap) == (here <= gap))
        reaches.push_back(asked_.log_lengths[sight.pair] + sight.log_depth);
    }
    if (reaches.empty()) return;
    const double told = Quantile(std::move(reaches), 0.5) - across.log_depth;
    (here <= gap ? votes_[gap].before : votes_[gap].behind).push_back({across.pair, told});
  }

  const AskedRays& asked_;
  RegisteredSequence places_;
  std::vector<GapVotes> votes_;  ///< behind each place
};

}  // namespace

std::vector<GapVotes> CollectGapVotes(const AskedRays& asked) {
  Collector collector(asked);
  ForEachRay(asked.depths, [&](std::span<const RayDepth> ray) { collector.Add(ray); });
  return collector.Take();
}

}  // namespace orbweave
