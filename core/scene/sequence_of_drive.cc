// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/scene/sequence_of_drive.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace orbweave {
namespace {

/// Of an image without a time.
constexpr int64_t kNoRank = -1;

bool HasTime(const ImageManifest& manifest, ImageId id) {
  return std::isfinite(manifest.At(id).capture_time_s.value_or(NAN));
}

/// For each image its number by time among those that have one.
std::vector<int64_t> RanksByTime(const ImageManifest& manifest, std::span<const ImageId> images) {
  std::vector<size_t> timed;
  for (size_t i = 0; i < images.size(); ++i) {
    if (HasTime(manifest, images[i])) timed.push_back(i);
  }
  std::ranges::stable_sort(
      timed, {}, [&](size_t i) { return *manifest.At(images[i]).capture_time_s; });
  std::vector<int64_t> ranks(images.size(), kNoRank);
  for (size_t rank = 0; rank < timed.size(); ++rank)
    ranks[timed[rank]] = static_cast<int64_t>(rank);
  return ranks;
}

/// For each image its own rank, else that of the next one behind it; `num_ranks` at the end.
std::vector<int64_t> RanksBehind(std::vector<int64_t> ranks, int64_t num_ranks) {
  int64_t behind = num_ranks;
  for (size_t i = ranks.size(); i-- > 0;) {
    if (ranks[i] == kNoRank) ranks[i] = behind;
    behind = ranks[i];
  }
  return ranks;
}

}  // namespace

TimeOrder OrderByTime(const ImageManifest& manifest, std::span<const ImageId> images) {
  const std::vector<int64_t> ranks = RanksByTime(manifest, images);
  const int64_t num_ranks = std::ssize(ranks) - std::ranges::count(ranks, kNoRank);
  const std::vector<int64_t> behind = RanksBehind(ranks, num_ranks);
  TimeOrder order;
  std::vector<int64_t> places;  // twice the rank, and odd between two of them
  int64_t before = -1;
  for (size_t i = 0; i < images.size(); ++i) {
    if (ranks[i] != kNoRank) {
      before = ranks[i];
      places.push_back(2 * before);
      continue;
    }
    places.push_back(before < 0 ? 2 * behind[i] - 1 : 2 * before + 1);
    if (behind[i] != before + 1) order.unsure.push_back(images[i]);
  }
  std::vector<size_t> indices(images.size());
  std::iota(indices.begin(), indices.end(), size_t{0});
  std::ranges::stable_sort(indices, {}, [&](size_t i) { return places[i]; });
  for (const size_t i : indices) order.sequence.push_back(images[i]);
  return order;
}

std::map<uint32_t, std::vector<ImageId>> SequenceOfDrives(const ImageManifest& manifest) {
  std::map<uint32_t, std::vector<ImageId>> drives;
  for (const ImageRecord& image : manifest.images) drives[image.drive].push_back(image.id);
  for (auto& [drive, sequence] : drives) sequence = OrderByTime(manifest, sequence).sequence;
  return drives;
}

std::vector<ImageId> TimedAmong(const ImageManifest& manifest, std::span<const ImageId> images) {
  std::vector<ImageId> timed;
  std::ranges::copy_if(
      images, std::back_inserter(timed), [&](ImageId id) { return HasTime(manifest, id); });
  return timed;
}

}  // namespace orbweave
