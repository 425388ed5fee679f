// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_against_decoys.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/features/match_descriptors.h"
#include "core/features/nearest_in_planes.h"
#include "core/geometry/place_pairs.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
/// Eight times the band of 4 px in a panorama of 2048 px: true matches are out of reach, and planes
/// still cut the street at nearly the same height.
constexpr double kTiltDeg = 6.0;
/// The street as it would be seen by a camera turned past its width, still upright.
constexpr double kYawDeg = 25.0;

/// A match and how many times as far its descriptors are as the nearest other of either.
struct RankedMatch {
  double slack = 1.0;
  FeatureMatch match{};
};

/// What planes of one geometry find.
struct PlaneMatches {
  NearestTwoBothWays nearest{};
  std::vector<FeatureMatch> accepted{};
};

void MergeInto(const std::vector<NearestTwo>& from, std::vector<NearestTwo>& into) {
  for (size_t i = 0; i < into.size(); ++i) into[i] = MergeNearest(into[i], from[i]);
}

/// Squared distance of the nearest feature other than `index`.
double NearestOther(const NearestTwo& nearest, FeatureIndex index) {
  return nearest.index == index ? nearest.second : nearest.best;
}

std::vector<RankedMatch> Rank(const std::vector<FeatureMatch>& matches,
                              const NearestTwoBothWays& in_planes,
                              const NearestTwoBothWays& nearest) {
  std::vector<RankedMatch> ranked;
  ranked.reserve(matches.size());
  for (const FeatureMatch& match : matches) {
    const double squared = in_planes.of_a[match.a].best;
    const double other = std::min(NearestOther(nearest.of_a[match.a], match.b),
                                  NearestOther(nearest.of_b[match.b], match.a));
    ranked.push_back({std::sqrt(squared / std::max(1.0, other)), match});
  }
  std::ranges::sort(ranked, [](const RankedMatch& x, const RankedMatch& y) {
    return x.slack != y.slack ? x.slack < y.slack : x.match < y.match;
  });
  return ranked;
}

std::array<Eigen::Quaterniond, 2> DecoysOf(const Rigid3& b_from_a) {
  const auto turned = [&](double angle_deg, const Eigen::Vector3d& axis) {
    const Eigen::AngleAxisd turn(angle_deg * kRadiansPerDegree, axis);
    return (turn * b_from_a.rotation).normalized();
  };
  return {turned(kTiltDeg, b_from_a.translation.normalized()),
          turned(kYawDeg, Eigen::Vector3d::UnitY())};
}

std::vector<FeatureMatch> Without(std::vector<FeatureMatch> matches,
                                  std::span<const FeatureMatch> others) {
  std::erase_if(matches, [&](const FeatureMatch& match) {
    return std::ranges::binary_search(others, match);
  });
  return matches;
}

/// Counts the matches without slack that speak for themselves, beside those that are known.
class TellingMatches {
 public:
  TellingMatches(const PairSide& a, const PairSide& b, std::span<const FeatureMatch> known)
      : a_(a), b_(b) {
    for (const FeatureMatch& match : known) Add(known_, match);
  }

  [[nodiscard]] size_t Count(const std::vector<RankedMatch>& ranked) const {
    PlacePairs places = known_;
    return static_cast<size_t>(std::ranges::count_if(ranked, [&](const RankedMatch& each) {
      return each.slack <= 1.0 && Add(places, each.match);
    }));
  }

 private:
  bool Add(PlacePairs& places, const FeatureMatch& match) const {
    return places.Add(a_.bearings[match.a], b_.bearings[match.b]);
  }

  const PairSide& a_;
  const PairSide& b_;
  PlacePairs known_{};
};

/// The longest list of which wrong_share is wrong at most.
size_t LongestTrusted(const std::vector<RankedMatch>& target,
                      const std::vector<std::vector<RankedMatch>>& decoys,
                      double wrong_share) {
  size_t longest = 0;
  for (size_t n = 1; n <= target.size(); ++n) {
    if (n < target.size() && target[n].slack == target[n - 1].slack) continue;
    size_t wrong = 0;
    for (const std::vector<RankedMatch>& decoy : decoys) {
      wrong += static_cast<size_t>(
          std::ranges::upper_bound(decoy, target[n - 1].slack, {}, &RankedMatch::slack) -
          decoy.begin());
    }
    const double share = static_cast<double>(wrong) / static_cast<double>(n * decoys.size());
    if (share <= wrong_share) longest = n;
  }
  return longest;
}

}  // namespace

PredictedMatches MatchAgainstDecoys(const PairSide& a,
                                    const PairSide& b,
                                    const Rigid3& b_from_a,
                                    double max_error_rad,
                                    const NearestTwoBothWays* nearest,
                                    std::optional<std::span<const FeatureMatch>> known,
                                    const MatchOptions& options) {
  const NearestInPlanes planes(a, b, b_from_a.translation, max_error_rad);
  const auto match = [&](const Eigen::Quaterniond& rotation) {
    PlaneMatches found{.nearest = planes.Find(rotation)};
    found.accepted = AcceptGuided(found.nearest, options);
    return found;
  };
  const PlaneMatches target = match(b_from_a.rotation);
  std::vector<PlaneMatches> decoys;
  for (const Eigen::Quaterniond& decoy : DecoysOf(b_from_a)) decoys.push_back(match(decoy));

  NearestTwoBothWays all = nearest != nullptr ? *nearest : target.nearest;
  for (const PlaneMatches& decoy : decoys) {
    if (nearest != nullptr) break;
    MergeInto(decoy.nearest.of_a, all.of_a);
    MergeInto(decoy.nearest.of_b, all.of_b);
  }
  const std::vector<RankedMatch> ranked = Rank(target.accepted, target.nearest, all);
  std::vector<std::vector<RankedMatch>> wrong;
  for (const PlaneMatches& decoy : decoys)
    wrong.push_back(Rank(Without(decoy.accepted, target.accepted), decoy.nearest, all));

  PredictedMatches predicted;
  if (known) {
    const TellingMatches telling(a, b, *known);
    size_t most_by_chance = 0;
    for (const auto& each : wrong) most_by_chance = std::max(most_by_chance, telling.Count(each));
    const size_t new_ones =
        telling.Count(Rank(Without(target.accepted, *known), target.nearest, all));
    predicted.log10_chance = Log10PoissonTail(new_ones, static_cast<double>(most_by_chance + 1));
  }
  const size_t trusted = LongestTrusted(ranked, wrong, options.guided_max_wrong_share);
  for (size_t i = 0; i < trusted; ++i) predicted.matches.push_back(ranked[i].match);
  std::ranges::sort(predicted.matches);
  return predicted;
}

}  // namespace orbweave
