// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/build_tracks.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/graph/feature_sets.h"

namespace orbweave {
namespace {

// Every feature some match names, sorted, and where an image's features begin among them.
struct FeatureTable {
  std::vector<FeatureRef> features{};
  std::map<ImageId, std::vector<uint32_t>> index_of{};  // image -> feature index -> position

  [[nodiscard]] const std::vector<uint32_t>& Of(ImageId image) const { return index_of.at(image); }
};

constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();

FeatureTable TabulateFeatures(std::span<const TwoViewGeometry> pairs) {
  FeatureTable table;
  const auto mark = [](std::vector<uint32_t>& used, FeatureIndex feature) {
    if (feature >= used.size()) used.resize(feature + 1, kUnused);
    used[feature] = 0;
  };
  for (const TwoViewGeometry& geometry : pairs) {
    std::vector<uint32_t>& in_a = table.index_of[geometry.pair.a];
    std::vector<uint32_t>& in_b = table.index_of[geometry.pair.b];
    for (const FeatureMatch& match : geometry.inliers) {
      mark(in_a, match.a);
      mark(in_b, match.b);
    }
  }
  for (auto& [image, used] : table.index_of) {
    for (FeatureIndex feature = 0; feature < used.size(); ++feature) {
      if (used[feature] == kUnused) continue;
      used[feature] = static_cast<uint32_t>(table.features.size());
      table.features.push_back({image, feature});
    }
  }
  return table;
}

std::vector<size_t> StrongestFirst(std::span<const TwoViewGeometry> pairs) {
  std::vector<size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t x, size_t y) {
    if (pairs[x].inliers.size() != pairs[y].inliers.size()) {
      return pairs[x].inliers.size() > pairs[y].inliers.size();
    }
    return pairs[x].pair < pairs[y].pair;
  });
  return order;
}

// Features come in sorted order, so tracks and their features do too.
std::vector<FeatureTrack> CollectTracks(const std::vector<FeatureRef>& features,
                                        FeatureSets& sets) {
  std::vector<FeatureTrack> tracks;
  std::vector<uint32_t> track_of_set(features.size(), kUnused);
  for (uint32_t i = 0; i < features.size(); ++i) {
    if (sets.SizeOf(i) < 2) continue;
    uint32_t& track = track_of_set[sets.Find(i)];
    if (track == kUnused) {
      track = static_cast<uint32_t>(tracks.size());
      tracks.emplace_back().features.reserve(sets.SizeOf(i));
    }
    tracks[track].features.push_back(features[i]);
  }
  return tracks;
}

}  // namespace

BuiltTracks BuildTracks(std::span<const TwoViewGeometry> pairs) {
  const FeatureTable table = TabulateFeatures(pairs);
  FeatureSets sets(table.features);
  BuiltTracks built;
  for (const size_t i : StrongestFirst(pairs)) {
    const std::vector<uint32_t>& in_a = table.Of(pairs[i].pair.a);
    const std::vector<uint32_t>& in_b = table.Of(pairs[i].pair.b);
    for (const FeatureMatch& match : pairs[i].inliers) {
      if (sets.TryJoin(in_a[match.a], in_b[match.b]) == FeatureSets::Join::kConflict) {
        ++built.num_conflicting;
      }
    }
  }
  built.tracks = CollectTracks(table.features, sets);
  return built;
}

}  // namespace orbweave
