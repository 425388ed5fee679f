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

TEST(SequenceOfDrives, FollowsIdsWithoutTimes) {
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({std::nullopt, NAN, std::nullopt})),
            (std::vector<uint32_t>{0, 1, 2}));
}

TEST(SequenceOfDrives, ATimeThatIsMissingLeavesTheOrderOfTheOthers) {
  EXPECT_EQ(SequenceOfFirst(ImagesTakenAt({40.0, 50.0, std::nullopt, NAN, 60.0, 10.0, 20.0})),
            (std::vector<uint32_t>{5, 6, 0, 1, 2, 3, 4}));
}

TEST(OrderByTime, IsSureOfAnImageBetweenOthersThatFollowOneAnother) {
  const ImageManifest manifest = ImagesTakenAt({std::nullopt, 10.0, std::nullopt, 20.0, 30.0, NAN});
  std::vector<ImageId> ids;
  for (const ImageRecord& image : manifest.images) ids.push_back(image.id);
  EXPECT_EQ(OrderByTime(manifest, ids).sequence, ids);
  EXPECT_TRUE(OrderByTime(manifest, ids).unsure.empty());
}

TEST(OrderByTime, NamesAnImageWhosePlaceTimesAndNamesTellDifferently) {
  // Between 30 and 10 by name: that is nowhere by time. Before 30 and behind 20 are others, too.
  const ImageManifest manifest =
      ImagesTakenAt({std::nullopt, 30.0, std::nullopt, 10.0, 20.0, std::nullopt});
  std::vector<ImageId> ids;
  for (const ImageRecord& image : manifest.images) ids.push_back(image.id);
  const TimeOrder order = OrderByTime(manifest, ids);
  EXPECT_EQ(order.unsure, (std::vector<ImageId>{ImageId(0), ImageId(2), ImageId(5)}));
  std::vector<uint32_t> values;
  for (const ImageId id : order.sequence) values.push_back(id.value);
  EXPECT_EQ(values, (std::vector<uint32_t>{3, 4, 0, 5, 1, 2}));
}

TEST(TimedAmong, LeavesOutWhatHasNoFiniteTime) {
  const ImageManifest manifest = ImagesTakenAt({30.0, std::nullopt, 10.0, NAN});
  const std::vector<ImageId> ids = {ImageId(2), ImageId(1), ImageId(3), ImageId(0)};
  EXPECT_EQ(TimedAmong(manifest, ids), (std::vector<ImageId>{ImageId(2), ImageId(0)}));
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
