// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/find_common_view.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace orbweave {
namespace {

std::vector<ImageId> CommonImages(const Reconstruction& a, const Reconstruction& b) {
  std::vector<ImageId> images;
  for (const auto& [id, image] : a.images) {
    const auto other = b.images.find(id);
    if (other != b.images.end() && !image.loose && !other->second.loose) images.push_back(id);
  }
  return images;
}

using TrackPairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Track pairs of one image's common features, one per feature.
void MeetInImage(std::span<const TrackedFeature> in_a,
                 std::span<const TrackedFeature> in_b,
                 TrackPairs& pairs) {
  size_t i = 0;
  size_t j = 0;
  while (i < in_a.size() && j < in_b.size()) {
    if (in_a[i].ref < in_b[j].ref) {
      ++i;
    } else if (in_b[j].ref < in_a[i].ref) {
      ++j;
    } else {
      pairs.emplace_back(in_a[i++].track, in_b[j++].track);
    }
  }
}

// Every track once, in the pair that most features vote for.
std::vector<CommonTrack> Elect(TrackPairs pairs, size_t num_tracks_a, size_t num_tracks_b) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::tuple<int64_t, uint32_t, uint32_t>> ballots;  // (-votes, track a, track b)
  for (const auto& [a, b] : pairs) {
    if (ballots.empty() || std::get<1>(ballots.back()) != a || std::get<2>(ballots.back()) != b) {
      ballots.emplace_back(0, a, b);
    }
    --std::get<0>(ballots.back());
  }
  std::sort(ballots.begin(), ballots.end());
  std::vector<uint8_t> is_taken_a(num_tracks_a, 0);
  std::vector<uint8_t> is_taken_b(num_tracks_b, 0);
  std::vector<CommonTrack> elected;
  for (const auto& [votes, a, b] : ballots) {
    if (is_taken_a[a] != 0 || is_taken_b[b] != 0) continue;
    is_taken_a[a] = is_taken_b[b] = 1;
    elected.push_back({a, b});
  }
  std::sort(elected.begin(), elected.end(), [](const CommonTrack& x, const CommonTrack& y) {
    return x.track_a < y.track_a;
  });
  return elected;
}

}  // namespace

std::vector<TrackedFeature> IndexFeatures(const Reconstruction& reconstruction) {
  std::vector<TrackedFeature> index;
  index.reserve(reconstruction.NumObservations());
  for (uint32_t t = 0; t < reconstruction.tracks.size(); ++t) {
    for (const Observation& observation : reconstruction.tracks[t].observations) {
      index.push_back({observation.ref, t});
    }
  }
  std::sort(index.begin(), index.end(), [](const TrackedFeature& x, const TrackedFeature& y) {
    return std::tie(x.ref, x.track) < std::tie(y.ref, y.track);
  });
  return index;
}

std::span<const TrackedFeature> FeaturesOf(std::span<const TrackedFeature> index, ImageId image) {
  const auto by_image = [](const TrackedFeature& feature, ImageId id) {
    return feature.ref.image < id;
  };
  const auto begin = std::lower_bound(index.begin(), index.end(), image, by_image);
  const auto end = std::lower_bound(begin, index.end(), ImageId(image.value + 1), by_image);
  return {begin, end};
}

CommonView FindCommonView(const Reconstruction& a,
                          std::span<const TrackedFeature> index_a,
                          const Reconstruction& b,
                          std::span<const TrackedFeature> index_b) {
  CommonView view{.images = CommonImages(a, b)};
  TrackPairs pairs;
  for (const ImageId image : view.images) {
    MeetInImage(FeaturesOf(index_a, image), FeaturesOf(index_b, image), pairs);
  }
  view.tracks = Elect(std::move(pairs), a.tracks.size(), b.tracks.size());
  return view;
}

}  // namespace orbweave
