// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/sequence_of_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace orbweave {
namespace {

ImageManifest ImagesTakenAt(const std::vector<std::optional<double>>& times_s) {
  ImageManifest manifest;
  for (const std::optional<double>& time_s : times_s) {
    const ImageId id(static_cast<uint32_t>(manifest.images.size()));
    manifest.images.push_back({.id = id, .capture_time_s = time_s});
  }
  return manifest;
}

std::vector<uint32_t> SequenceOfFirst(const ImageManifest& manifest) {
  std::vector<uint32_t> values;
  const auto sequences = SequenceOfDrives(manifest);
  for (const ImageId id : sequences.at(0)) values.push_back(id.value);
  return values;
}

TEST(SequenceOfDrives, FollowsTimesWhereAllImagesHaveOne) {
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({30.0, 10.0, 20.0})), (std::vector<uint32_t>{1, 2, 0}));
}

TEST(SequenceOfDrives, FollowsIdsWhereATimeIsMissingOrNoNumber) {
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({30.0, std::nullopt, 20.0})),
            (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({30.0, NAN, 20.0})), (std::vector<uint32_t>{0, 1, 2}));
}

TEST(SequenceOfDrives, KeepsTheOrderOfIdsAtEqualTimes) {
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({5.0, 5.0, 1.0, 5.0})),
            (std::vector<uint32_t>{2, 0, 1, 3}));
}

TEST(SequenceOfDrives, OrdersEachDriveByItself) {
  ImageManifest manifest = ImagesTakenAt({4.0, 3.0, std::nullopt, 1.0});
  manifest.images[2].drive = manifest.images[3].drive = 7;
  const auto sequences = SequenceOfDrives(manifest);
  ASSERT_EQ(sequences.size(), 2U);
  EXPECT_EQ(sequences.at(0), (std::vector<ImageId>{ImageId(1), ImageId(0)}));
  EXPECT_EQ(sequences.at(7), (std::vector<ImageId>{ImageId(2), ImageId(3)}));
}

TEST(SequenceOfDrives, IsEmptyWithoutImages) { EXPECT_TRUE(SequenceOfDrives({}).empty()); }

}  // namespace
}  // namespace orbweave
