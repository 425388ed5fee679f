// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/scene/sequence_of_drive.h"

#include <algorithm>
#include <cmath>

namespace orbweave {

std::map<uint32_t, std::vector<ImageId>> SequenceOfDrives(const ImageManifest& manifest) {
  std::map<uint32_t, std::vector<ImageId>> drives;
  for (const ImageRecord& image : manifest.images) drives[image.drive].push_back(image.id);
  for (auto& [drive, sequence] : drives) {
    if (!HaveTimes(manifest, sequence)) continue;
    std::ranges::stable_sort(
        sequence, {}, [&](ImageId id) { return *manifest.At(id).capture_time_s; });
  }
  return drives;
}

bool HaveTimes(const ImageManifest& manifest, std::span<const ImageId> sequence) {
  return std::ranges::all_of(sequence, [&](ImageId id) {
    return std::isfinite(manifest.At(id).capture_time_s.value_or(NAN));
  });
}

}  // namespace orbweave
