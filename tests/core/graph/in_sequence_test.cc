// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/in_sequence.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace orbweave {
namespace {

/// Images of one drive with these numbers, 8 m apart for each.
ImageManifest Numbered(const std::vector<int>& numbers, bool with_gnss) {
  ImageManifest manifest;
  for (const int number : numbers) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(static_cast<uint32_t>(manifest.images.size() - 1));
    image.name = std::to_string(number) + ".jpg";
    image.prior.horizontal_sigma_m = 1.0;
    if (with_gnss) image.prior.position_in_enu = Eigen::Vector3d(8.0 * number, 0.0, 0.0);
  }
  return manifest;
}

bool AreInSequence(const ImageManifest& manifest, uint32_t a, uint32_t b) {
  return IsInSequence(MakePair(ImageId(a), ImageId(b)), PlacesInDrives(manifest));
}

TEST(IsInSequence, FiveCapturesApart) {
  const ImageManifest drive = Numbered({1, 2, 3, 4, 5, 6, 7, 8}, false);
  EXPECT_TRUE(AreInSequence(drive, 0, 5));
  EXPECT_TRUE(AreInSequence(drive, 6, 1));
  EXPECT_FALSE(AreInSequence(drive, 0, 6));
}

TEST(IsInSequence, CountsCapturesThatAreMissing) {
  const ImageManifest drive = Numbered({1, 2, 3, 4, 8, 9, 10, 26, 27}, false);
  EXPECT_TRUE(AreInSequence(drive, 2, 4));
  EXPECT_FALSE(AreInSequence(drive, 1, 4));
  EXPECT_FALSE(AreInSequence(drive, 6, 7));
}

TEST(IsInSequence, WhateverPositionsJump) {
  ImageManifest drive = Numbered({1, 2, 3, 4, 5, 6, 7, 8}, true);
  for (uint32_t i = 4; i < 8; ++i) drive.images[i].prior.position_in_enu->y() += 100.0;
  EXPECT_TRUE(AreInSequence(drive, 3, 4));
}

TEST(IsInSequence, NotOfTwoDrives) {
  ImageManifest drives = Numbered({1, 2, 3, 4}, true);
  drives.images[2].drive = drives.images[3].drive = 1;
  EXPECT_TRUE(AreInSequence(drives, 0, 1));
  EXPECT_FALSE(AreInSequence(drives, 1, 2));
}

}  // namespace
}  // namespace orbweave
