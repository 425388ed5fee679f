// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/scene/places_in_drives.h"

#include <algorithm>

#include "core/scene/captures_along.h"
#include "core/scene/left_off.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

/// For each image of a sequence, in which stretch of it.
std::vector<uint32_t> StretchesOf(const std::vector<ImageId>& sequence,
                                  const ImageManifest& manifest) {
  const std::vector<uint8_t> left_off = LeftOffBehind(manifest, sequence);
  std::vector<uint32_t> stretches(sequence.size(), 0);
  for (size_t i = 1; i < stretches.size(); ++i) stretches[i] = stretches[i - 1] + left_off[i - 1];
  return stretches;
}

}  // namespace

PlacesInDrives::PlacesInDrives(const ImageManifest& manifest)
    : sequences_(SequenceOfDrives(manifest)),
      drive_(manifest.images.size()),
      place_(manifest.images.size()),
      capture_(manifest.images.size()),
      stretch_(manifest.images.size()) {
  for (const auto& [drive, sequence] : sequences_) {
    const std::vector<uint32_t> stretches = StretchesOf(sequence, manifest);
    const std::vector<uint32_t> captures = CapturesAlong(manifest, sequence);
    for (uint32_t place = 0; place < sequence.size(); ++place) {
      drive_[sequence[place].value] = drive;
      place_[sequence[place].value] = place;
      capture_[sequence[place].value] = captures[place];
      stretch_[sequence[place].value] = stretches[place];
    }
  }
}

const std::vector<ImageId>& PlacesInDrives::SequenceOf(ImageId image) const {
  return sequences_.at(drive_[image.value]);
}

bool PlacesInDrives::AreOfOneDrive(const ImagePair& pair) const {
  return drive_[pair.a.value] == drive_[pair.b.value];
}

std::optional<uint32_t> PlacesInDrives::StepsBetween(const ImagePair& pair) const {
  if (!AreOfOneDrive(pair)) return std::nullopt;
  const auto [first, last] = std::minmax({PlaceOf(pair.a), PlaceOf(pair.b)});
  return last - first;
}

std::optional<uint32_t> PlacesInDrives::CapturesBetween(const ImagePair& pair) const {
  if (!AreOfOneDrive(pair)) return std::nullopt;
  const auto [first, last] = std::minmax({capture_[pair.a.value], capture_[pair.b.value]});
  return last - first;
}

bool PlacesInDrives::AreOfOneStretch(const ImagePair& pair) const {
  return AreOfOneDrive(pair) && stretch_[pair.a.value] == stretch_[pair.b.value];
}

std::optional<ImageId> PlacesInDrives::Before(ImageId image) const {
  const uint32_t place = PlaceOf(image);
  if (place == 0) return std::nullopt;
  return SequenceOf(image)[place - 1];
}

std::optional<ImageId> PlacesInDrives::After(ImageId image) const {
  const uint32_t place = PlaceOf(image) + 1;
  if (place == SequenceOf(image).size()) return std::nullopt;
  return SequenceOf(image)[place];
}

}  // namespace orbweave
