// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/select_image_pairs/find_carriers.h"

#include <algorithm>
#include <utility>

#include "core/features/find_carrier.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr size_t kPanoramas = 24;  // of a drive: 276 pairs

std::vector<ImageId> EvenlyChosen(const ImageManifest& manifest,
                                  const std::vector<ImageId>& sequence) {
  std::vector<ImageId> placed;
  for (const ImageId id : sequence)
    if (manifest.At(id).prior.position_in_enu) placed.push_back(id);
  const size_t count = std::min(placed.size(), kPanoramas);
  std::vector<ImageId> chosen;
  for (size_t i = 0; i < count; ++i) chosen.push_back(placed[i * placed.size() / count]);
  return chosen;
}

}  // namespace

absl::StatusOr<std::vector<Carrier>> FindCarriers(const ImageManifest& manifest,
                                                  const FetchFeatures& fetch) {
  std::vector<Carrier> carriers;
  for (auto& [drive, sequence] : SequenceOfDrives(manifest)) {
    std::vector<PlacedPanorama> panoramas;
    for (const ImageId id : EvenlyChosen(manifest, sequence)) {
      const PosePrior& prior = manifest.At(id).prior;
      ORBWEAVE_ASSIGN_OR_RETURN(Features features, fetch(id));
      panoramas.push_back(
          {std::move(features), prior.position_in_enu->head<2>(), prior.horizontal_sigma_m});
    }
    Carrier carrier{.images = sequence, .cells = FindCarrier(panoramas)};
    if (carrier.cells.empty()) continue;
    std::ranges::sort(carrier.images);
    carriers.push_back(std::move(carrier));
  }
  return carriers;
}

}  // namespace orbweave
