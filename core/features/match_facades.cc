// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_facades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "core/features/find_nearest_two.h"
#include "core/features/match_descriptors.h"

namespace orbweave {
namespace {

/// Of each view, to find the turn by. Four to five walls of eight views that are common to both
/// have fifty matches of so many; by chance they have ten.
constexpr size_t kLargest = 400;

/// Descriptors of the largest `count` features of a view.
std::span<const uint8_t> DescriptorsOf(const PairSide& side, size_t view, size_t count) {
  const size_t first = side.first_of_view[view];
  const size_t size = std::min(count, side.first_of_view[view + 1] - first);
  return std::span(side.features.descriptors)
      .subspan(first * kDescriptorSize, size * kDescriptorSize);
}

/// Views of b by views of a.
class TurnedViews {
 public:
  TurnedViews(const PairSide& a, const PairSide& b, const MatchOptions& options)
      : a_(a), b_(b), options_(options) {}

  [[nodiscard]] size_t BestTurn() const {
    std::array<size_t, kNumFacadeViews> counts{};
    for (size_t turn = 0; turn < counts.size(); ++turn) counts[turn] = Match(turn, kLargest).size();
    return static_cast<size_t>(std::ranges::max_element(counts) - counts.begin());
  }

  /// Of the `count` largest features of each view; view after view.
  [[nodiscard]] std::vector<RatedMatch> Match(size_t turn, size_t count) const {
    std::vector<RatedMatch> matches;
    for (size_t view = 0; view < kNumFacadeViews; ++view) {
      const size_t other = (view + turn) % kNumFacadeViews;
      const std::span<const uint8_t> of_a = DescriptorsOf(a_, view, count);
      const std::span<const uint8_t> of_b = DescriptorsOf(b_, other, count);
      if (of_a.empty() || of_b.empty()) continue;
      const NearestTwoBothWays nearest = FindNearestTwo(of_a, of_b);
      for (RatedMatch rated : RateMatches(AcceptNearest(nearest, options_), nearest)) {
        rated.match.a += static_cast<FeatureIndex>(a_.first_of_view[view]);
        rated.match.b += static_cast<FeatureIndex>(b_.first_of_view[other]);
        matches.push_back(rated);
      }
    }
    return matches;
  }

 private:
  const PairSide& a_;
  const PairSide& b_;
  const MatchOptions& options_;
};

/// Remembers where matches were, to a grid of chords of `cell` on the unit sphere.
class TakenPlaces {
 public:
  explicit TakenPlaces(double cell) : cell_(cell) {}

  /// Whether nothing was there.
  bool Take(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return taken_
        .insert(
            {Index(a.x()), Index(a.y()), Index(a.z()), Index(b.x()), Index(b.y()), Index(b.z())})
        .second;
  }

 private:
  [[nodiscard]] int Index(double coordinate) const {
    return static_cast<int>(std::floor(coordinate / cell_));
  }

  double cell_ = 0.0;
  std::set<std::array<int, 6>> taken_{};
};

}  // namespace

std::vector<RatedMatch> MatchFacades(const PairSide& a,
                                     const PairSide& b,
                                     double same_rad,
                                     const MatchOptions& options) {
  if (!a.HasFacades() || !b.HasFacades()) return {};
  const TurnedViews views(a, b, options);
  TakenPlaces taken(same_rad);
  std::vector<RatedMatch> matches =
      views.Match(views.BestTurn(), std::numeric_limits<size_t>::max());
  std::erase_if(matches, [&](const RatedMatch& rated) {
    return !taken.Take(a.bearings[rated.match.a], b.bearings[rated.match.b]);
  });
  std::ranges::sort(matches, {}, &RatedMatch::match);
  return matches;
}

}  // namespace orbweave
