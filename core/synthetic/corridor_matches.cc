// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_matches.h"

#include <algorithm>
#include <map>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr size_t kMinMatches = 15;
constexpr int kDrawsForAFreeFeature = 50;

/// Features of the same points; both lists ascend.
std::vector<FeatureMatch> CommonFeatures(const std::vector<uint32_t>& a,
                                         const std::vector<uint32_t>& b) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j])
      matches.push_back({i++, j++});
    else if (a[i] < b[j])
      ++i;
    else
      ++j;
  }
  return matches;
}

/// Turns a share of true matches into what a matcher would have got wrong: a feature of a joined
/// with a random one of b that is not matched yet.
void AddWrongMatches(double share,
                     size_t features_in_b,
                     Random& random,
                     std::vector<FeatureMatch>& matches) {
  std::vector<uint8_t> taken(features_in_b, 0);
  for (const FeatureMatch& match : matches) taken[match.b] = 1;
  for (FeatureMatch& match : matches) {
    if (random.Uniform() >= share) continue;
    uint32_t wrong = match.b;
    for (int draw = 0; draw < kDrawsForAFreeFeature && taken[wrong]; ++draw) {
      wrong = random.Index(static_cast<uint32_t>(features_in_b));
    }
    if (taken[wrong]) continue;
    taken[match.b] = 0;
    taken[wrong] = 1;
    match.b = wrong;
  }
}

/// Adds features of copies of one appearance, of those whose own point the other panorama does not
/// show. Where a panorama shows several copies, the last one matches.
void AddLookAlikes(const Corridor& corridor,
                   const ImagePair& pair,
                   std::vector<FeatureMatch>& matches) {
  const std::vector<uint32_t>& points_a = corridor.point_of_feature[pair.a.value];
  const std::vector<uint32_t>& points_b = corridor.point_of_feature[pair.b.value];
  std::vector<uint8_t> is_matched_a(points_a.size(), 0);
  std::vector<uint8_t> is_matched_b(points_b.size(), 0);
  for (const FeatureMatch& match : matches) is_matched_a[match.a] = is_matched_b[match.b] = 1;
  std::map<uint32_t, uint32_t> feature_in_b;
  for (uint32_t f = 0; f < points_b.size(); ++f) {
    if (is_matched_b[f] == 0 && points_b[f] < kCarrierPoint)
      feature_in_b[corridor.appearance_of_point[points_b[f]]] = f;
  }
  for (uint32_t f = 0; f < points_a.size(); ++f) {
    if (is_matched_a[f] != 0 || points_a[f] >= kCarrierPoint) continue;
    const auto found = feature_in_b.find(corridor.appearance_of_point[points_a[f]]);
    if (found == feature_in_b.end()) continue;
    matches.push_back({f, found->second});
    feature_in_b.erase(found);
  }
  std::sort(matches.begin(), matches.end());
}

/// Later panoramas that `a` is matched with, ascending.
std::vector<uint32_t> PartnersOf(uint32_t a,
                                 const CorridorOptions& options,
                                 const CorridorPath& path,
                                 const PlanarGrid& cameras) {
  const auto n = static_cast<uint32_t>(path.stations.size());
  std::vector<uint32_t> partners = cameras.Within(path.stations[a].place.position, kMeetingRadiusM);
  const auto window = static_cast<uint32_t>(options.match_window);
  for (uint32_t b = a + 1; b < n && b <= a + window; ++b) partners.push_back(b);
  if (const auto period = static_cast<uint32_t>(options.repeat_after); period > 0) {
    for (uint32_t b = a + period - 1; b < n && b <= a + period + 1; ++b) partners.push_back(b);
  }
  std::sort(partners.begin(), partners.end());
  partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
  std::erase_if(partners, [a](uint32_t b) { return b <= a; });
  return partners;
}

}  // namespace

void MakePairs(const CorridorOptions& options,
               const CorridorPath& path,
               const PlanarGrid& cameras,
               Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 3);
  for (uint32_t a = 0; a < path.stations.size(); ++a) {
    for (const uint32_t b : PartnersOf(a, options, path, cameras)) {
      PairMatches pair{{ImageId(a), ImageId(b)},
                       CommonFeatures(corridor.point_of_feature[a], corridor.point_of_feature[b])};
      if (options.repeat_after > 0) AddLookAlikes(corridor, pair.pair, pair.matches);
      if (pair.matches.size() < kMinMatches) continue;
      AddWrongMatches(options.outlier_share, corridor.features[b].size(), random, pair.matches);
      corridor.pairs.push_back(std::move(pair));
    }
  }
}

}  // namespace orbweave
