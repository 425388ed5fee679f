// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/gap_votes.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/ray_depths.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/lengths/street_lines.h"

namespace orbweave {
namespace {

/// A pair of a ray, seen from the image of the ray.
struct Sight {
  uint32_t pair = 0;  ///< of those asked
  size_t other = 0;   ///< place of the other image
  double log_depth = 0.0;
  double reach = 0.0;  ///< how far the ray reaches by it and by the model's length of the pair

  /// Whether it leads across the gap behind a place.
  [[nodiscard]] bool LeadsAcross(size_t gap, size_t here) const {
    return (other <= gap) != (here <= gap);
  }
};

class Collector {
 public:
  explicit Collector(const AskedRays& asked)
      : asked_(asked),
        places_(asked.state, kMatchTolerance * asked.max_error_px),
        votes_(places_.size()) {
    for (WayAlongLine& way : WaysAlongLines(asked.state, places_))
      static_cast<WayAlongLine&>(votes_[places_.PlaceOf(way.image)]) = std::move(way);
  }

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    const ImageSlot own = asked_.state.Graph().image_of_node[depths.front().node];
    const size_t here = places_.PlaceOf(own);
    CollectSights(own, depths);
    const size_t first = here - std::min(here, kReachAlongLine);
    const size_t last = std::min(here + kReachAlongLine, places_.size() - 1);
    for (size_t gap = first; gap < last; ++gap) Ask(depths.front().node, here, gap);
  }

  /// Without those where a line ends.
  [[nodiscard]] std::vector<GapVotes> Take() {
    std::vector<GapVotes> gaps;
    for (size_t place = 0; place + 1 < places_.size(); ++place) {
      const bool is_way =
          places_.LineOf(places_.At(place)) == places_.LineOf(places_.At(place + 1));
      if (is_way) gaps.push_back(std::move(votes_[place]));
    }
    return gaps;
  }

 private:
  /// Those with images of the same line.
  void CollectSights(ImageSlot own, std::span<const RayDepth> depths) {
    sights_.clear();
    for (const RayDepth& depth : depths) {
      const LinkedPair& pair = asked_.state.Graph().pairs[asked_.pairs[depth.pair]];
      const ImageSlot other = pair.Other(own);
      if (places_.LineOf(other) != places_.LineOf(own)) continue;
      sights_.push_back({.pair = depth.pair,
                         .other = places_.PlaceOf(other),
                         .log_depth = depth.log_depth,
                         .reach = asked_.log_lengths[depth.pair] + depth.log_depth});
    }
  }

  /// What the pairs on this side of the gap say of those that lead across it.
  void Ask(Node ray, size_t here, size_t gap) {
    across_.clear();
    for (const Sight& sight : sights_) {
      const size_t apart = std::max(here, sight.other) - std::min(here, sight.other);
      if (apart <= kReachAlongLine && sight.LeadsAcross(gap, here)) across_.push_back(sight);
    }
    votes_[gap].asked += static_cast<uint32_t>(across_.size());
    if (across_.empty()) return;
    const std::optional<double> reach = ReachOnThisSide(here, gap);
    if (!reach) return;
    std::vector<LengthVote>& votes = here <= gap ? votes_[gap].before : votes_[gap].behind;
    for (const Sight& sight : across_) votes.push_back({sight.pair, *reach - sight.log_depth, ray});
  }

  /// The median; nullopt where no pair stays on this side.
  [[nodiscard]] std::optional<double> ReachOnThisSide(size_t here, size_t gap) {
    reaches_.clear();
    for (const Sight& sight : sights_) {
      if (!sight.LeadsAcross(gap, here)) reaches_.push_back(sight.reach);
    }
    return MedianReach(reaches_);
  }

  const AskedRays& asked_;
  RegisteredSequence places_;
  std::vector<GapVotes> votes_;  ///< behind each place
  // Of the ray at hand; kept for their memory.
  std::vector<Sight> sights_{};
  std::vector<Sight> across_{};
  std::vector<double> reaches_{};
};

}  // namespace

std::vector<GapVotes> CollectGapVotes(const AskedRays& asked) {
  Collector collector(asked);
  ForEachRay(asked.depths, [&](std::span<const RayDepth> ray) { collector.Add(ray); });
  return collector.Take();
}

}  // namespace orbweave
