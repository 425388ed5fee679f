// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/select_image_pairs.h"

#include <algorithm>

#include "core/graph/find_near_positions.h"
#include "core/graph/near_by_gnss.h"
#include "core/scene/folder_of.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

using Pairs = std::vector<ImagePair>;

void AddEveryPair(const ImageManifest& manifest, Pairs& pairs) {
  for (size_t i = 0; i < manifest.images.size(); ++i) {
    for (size_t j = i + 1; j < manifest.images.size(); ++j) {
      pairs.push_back({manifest.images[i].id, manifest.images[j].id});
    }
  }
}

void AddSequencePairs(const ImageManifest& manifest, size_t window, Pairs& pairs) {
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest)) {
    for (size_t i = 0; i < sequence.size(); ++i) {
      for (size_t j = i + 1; j < sequence.size() && j - i <= window; ++j) {
        pairs.push_back(MakePair(sequence[i], sequence[j]));
      }
    }
  }
}

/// Whether anything but its name tells where or when an image was taken.
bool IsPlaced(const ImageRecord& image) {
  return image.prior.position_in_enu || image.capture_time_s;
}

void AddPairsByName(const ImageManifest& manifest, size_t window, Pairs& pairs) {
  const std::vector<ImageRecord>& images = manifest.images;
  for (size_t i = 0; i < images.size(); ++i) {
    for (size_t j = i + 1; j < images.size() && j - i <= window; ++j) {
      if (images[i].drive == images[j].drive || IsPlaced(images[i]) == IsPlaced(images[j]))
        continue;
      if (FolderOf(images[i].name) == FolderOf(images[j].name))
        pairs.push_back(MakePair(images[i].id, images[j].id));
    }
  }
}

void AddGnssPairs(const ImageManifest& manifest, const PairOptions& options, Pairs& pairs) {
  std::vector<ImageId> ids;
  std::vector<Eigen::Vector2d> positions;
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.position_in_enu) continue;
    ids.push_back(image.id);
    positions.push_back(image.prior.position_in_enu->head<2>());
  }
  const auto add = [&](double radius_m, int max_neighbours) {
    const auto near = FindNearPositions(positions, radius_m, static_cast<size_t>(max_neighbours));
    for (size_t i = 0; i < near.size(); ++i) {
      for (const uint32_t j : near[i]) pairs.push_back(MakePair(ids[i], ids[j]));
    }
  };
  if (options.gnss_radius_m <= 0.0) return;
  add(options.gnss_radius_m, options.gnss_max_neighbours);
  add(std::max(options.gnss_radius_m, options.similar_gate_m),
      std::min(options.gnss_min_neighbours, options.gnss_max_neighbours));
}

void AddSimilarPairs(const ImageManifest& manifest,
                     const std::vector<std::vector<ImageId>>& similar,
                     const PairOptions& options,
                     Pairs& pairs) {
  const size_t count = std::min(similar.size(), manifest.images.size());
  for (size_t i = 0; i < count; ++i) {
    const ImageRecord& image = manifest.images[i];
    for (const ImageId other : similar[i]) {
      if (other == image.id) continue;
      if (!MayBeNear(image.prior, manifest.At(other).prior, options)) continue;
      pairs.push_back(MakePair(image.id, other));
    }
  }
}

}  // namespace

std::vector<ImagePair> SelectImagePairs(const ImageManifest& manifest,
                                        const std::vector<std::vector<ImageId>>& similar,
                                        const PairOptions& options) {
  Pairs pairs;
  if (manifest.images.size() < static_cast<size_t>(options.exhaustive_below)) {
    AddEveryPair(manifest, pairs);
    return pairs;
  }
  AddSequencePairs(manifest, static_cast<size_t>(options.sequence_window), pairs);
  AddPairsByName(manifest, static_cast<size_t>(options.sequence_window), pairs);
  AddGnssPairs(manifest, options, pairs);
  AddSimilarPairs(manifest, similar, options, pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace orbweave
