// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Where each image stands in the sequence of its drive (SequenceOfDrives): by time where all
/// images of the drive have one, else by id.
class PlacesInDrives {
 public:
  explicit PlacesInDrives(const ImageManifest& manifest);

  /// From 0 on, within its drive.
  [[nodiscard]] uint32_t PlaceOf(ImageId image) const { return place_[image.value]; }
  [[nodiscard]] bool AreOfOneDrive(const ImagePair& pair) const;
  /// Images of the drive from one to the other; nullopt where they are of two drives.
  [[nodiscard]] std::optional<uint32_t> StepsBetween(const ImagePair& pair) const;
  /// The same, with captures that were taken out (CapturesAlong).
  [[nodiscard]] std::optional<uint32_t> CapturesBetween(const ImagePair& pair) const;
  /// Whether both are of one drive that was not left off between them (LeftOffBehind).
  [[nodiscard]] bool AreOfOneStretch(const ImagePair& pair) const;
  /// The one before or after it in its drive; nullopt at the ends.
  [[nodiscard]] std::optional<ImageId> Before(ImageId image) const;
  [[nodiscard]] std::optional<ImageId> After(ImageId image) const;

 private:
  [[nodiscard]] const std::vector<ImageId>& SequenceOf(ImageId image) const;

  std::map<uint32_t, std::vector<ImageId>> sequences_;
  std::vector<uint32_t> drive_;    ///< per image
  std::vector<uint32_t> place_;    ///< per image
  std::vector<uint32_t> capture_;  ///< per image
  std::vector<uint32_t> stretch_;  ///< per image, from 0 on within its drive
};

}  // namespace orbweave
