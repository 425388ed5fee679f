// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/list_pair_candidates.h"

#include <algorithm>
#include <iterator>

#include "core/graph/select_image_pairs.h"

namespace orbweave {
namespace {

using Pairs = std::vector<ImagePair>;
using Similar = std::vector<std::vector<ImageId>>;

/// The best few of each image; none where GNSS tells the neighbours: appearance has nothing to add
/// there but repeated facades.
Similar MostSimilar(const ImageManifest& manifest, Similar similar, int count) {
  similar.resize(std::min(similar.size(), manifest.images.size()));
  for (size_t i = 0; i < similar.size(); ++i) {
    const size_t kept = manifest.images[i].prior.position_in_enu ? 0 : static_cast<size_t>(count);
    if (similar[i].size() > kept) similar[i].resize(kept);
  }
  return similar;
}

PairOptions Nearest(PairOptions options) {
  for (int* count :
       {&options.sequence_window, &options.gnss_max_neighbours, &options.gnss_min_neighbours})
    *count = std::min(*count, options.first_neighbours);
  return options;
}

PairOptions Wider(PairOptions options) {
  options.sequence_window *= kReserveFactor;
  options.gnss_radius_m *= kReserveFactor;
  options.gnss_max_neighbours *= kReserveFactor;
  options.gnss_min_neighbours *= kReserveFactor;
  return options;
}

Pairs Without(const Pairs& pairs, const Pairs& others) {
  Pairs rest;
  std::ranges::set_difference(pairs, others, std::back_inserter(rest));
  return rest;
}

}  // namespace

PairCandidates ListPairCandidates(const ImageManifest& manifest,
                                  const Similar& similar,
                                  int num_similar,
                                  const PairOptions& options) {
  const auto select = [&](int most_similar, const PairOptions& by) {
    return SelectImagePairs(manifest, MostSimilar(manifest, similar, most_similar), by);
  };
  const bool is_small = manifest.images.size() < static_cast<size_t>(options.exhaustive_below);
  const Pairs usual = select(num_similar, options);
  if (options.first_neighbours == 0 || is_small) return {.first = usual};
  const Pairs nearest = select(std::min(num_similar, options.first_neighbours), Nearest(options));
  PairCandidates candidates;
  candidates.second = Without(usual, nearest);
  candidates.first = Without(usual, candidates.second);
  candidates.reserve = Without(SelectImagePairs(manifest, similar, Wider(options)), usual);
  return candidates;
}

}  // namespace orbweave
