// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/match_against_decoys.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/features/descriptor_distance.h"
#include "core/features/match_guided.h"
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

/// A match and how many times as far its descriptors are as the nearest in the whole image.
struct RankedMatch {
  double slack = 1.0;
  FeatureMatch match{};
};

std::vector<RankedMatch> Rank(const Features& a,
                              const Features& b,
                              const std::vector<FeatureMatch>& matches,
                              const NearestTwoBothWays& nearest) {
  std::vector<RankedMatch> ranked;
  ranked.reserve(matches.size());
  for (const FeatureMatch& match : matches) {
    const double squared = SquaredDistance(a.Descriptor(match.a), b.Descriptor(match.b));
    const double least = std::min(nearest.of_a[match.a].best, nearest.of_b[match.b].best);
    const double slack = squared <= least ? 1.0 : std::sqrt(squared / std::max(1.0, least));
    ranked.push_back({slack, match});
  }
  std::ranges::sort(ranked, [](const RankedMatch& x, const RankedMatch& y) {
    return x.slack != y.slack ? x.slack < y.slack : x.match < y.match;
  });
  return ranked;
}

std::array<Rigid3, 2> DecoysOf(const Rigid3& b_from_a) {
  const auto turned = [&](double angle_deg, const Eigen::Vector3d& axis) {
    const Eigen::AngleAxisd turn(angle_deg * kRadiansPerDegree, axis);
    return Rigid3{(turn * b_from_a.rotation).normalized(), b_from_a.translation};
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

/// How many of the matches that are nearest in the whole image speak for themselves, beside those
/// that are known.
size_t CountTelling(const Features& a,
                    const Features& b,
                    const std::vector<RankedMatch>& ranked,
                    std::span<const FeatureMatch> known) {
  PlacePairs places;
  for (const FeatureMatch& match : known) places.Add(a.Bearing(match.a), b.Bearing(match.b));
  return static_cast<size_t>(std::ranges::count_if(ranked, [&](const RankedMatch& each) {
    return each.slack <= 1.0 && places.Add(a.Bearing(each.match.a), b.Bearing(each.match.b));
  }));
}

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

PredictedMatches MatchAgainstDecoys(const Features& a,
                                    const Features& b,
                                    const Rigid3& b_from_a,
                                    double max_error_rad,
                                    const NearestTwoBothWays& nearest,
                                    std::span<const FeatureMatch> known,
                                    const MatchOptions& options) {
  const std::vector<FeatureMatch> found = MatchGuided(a, b, b_from_a, max_error_rad, options);
  const std::vector<RankedMatch> target = Rank(a, b, found, nearest);
  std::vector<std::vector<RankedMatch>> decoys;
  size_t most_by_chance = 0;
  for (const Rigid3& decoy : DecoysOf(b_from_a)) {
    const std::vector<FeatureMatch> wrong =
        Without(MatchGuided(a, b, decoy, max_error_rad, options), found);
    decoys.push_back(Rank(a, b, wrong, nearest));
    most_by_chance = std::max(most_by_chance, CountTelling(a, b, decoys.back(), known));
  }
  const size_t new_ones = CountTelling(a, b, Rank(a, b, Without(found, known), nearest), known);
  PredictedMatches predicted{
      .log10_chance = Log10PoissonTail(new_ones, static_cast<double>(most_by_chance + 1))};
  const size_t trusted = LongestTrusted(target, decoys, options.guided_max_wrong_share);
  for (size_t i = 0; i < trusted; ++i) predicted.matches.push_back(target[i].match);
  std::ranges::sort(predicted.matches);
  return predicted;
}

}  // namespace orbweave
