// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/drive_sequences.h"

#include <utility>

#include "core/scene/order_along_way.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

void OrderByPlace(const std::map<ImageId, Eigen::Vector3d>& places, DriveSequence& sequence) {
  std::vector<Eigen::Vector3d> in_order;
  for (const ImageId id : sequence.images) in_order.push_back(places.at(id));
  const auto order = OrderIfInNone(in_order);
  if (!order) return;
  sequence.is_by_place = true;
  const std::vector<ImageId> by_name = std::exchange(sequence.images, {});
  for (const uint32_t i : *order) sequence.images.push_back(by_name[i]);
}

}  // namespace

std::vector<DriveSequence> DriveSequences(const std::map<ImageId, Eigen::Vector3d>& places,
                                          const ImageManifest& manifest) {
  std::vector<DriveSequence> sequences;
  for (const auto& [drive, images] : SequenceOfDrives(manifest)) {
    DriveSequence sequence{.drive = drive};
    for (const ImageId id : images) {
      if (places.contains(id)) sequence.images.push_back(id);
    }
    if (sequence.images.empty()) continue;
    if (TimedAmong(manifest, images).empty()) OrderByPlace(places, sequence);
    sequences.push_back(std::move(sequence));
  }
  return sequences;
}

}  // namespace orbweave
