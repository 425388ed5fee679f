// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/select_image_pairs/find_carriers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/geometry/sphere_cells.h"
#include "tests/support/random_features.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using ::testing::IsEmpty;

constexpr uint32_t kOfEach = 40;
constexpr double kStep_m = 8.0;

/// Two drives, the images of one and the other by turns, of which the first has a mark that no
/// other has.
struct TwoDrives {
  ImageManifest manifest{};
  Eigen::Vector3d mark = Eigen::Vector3d(0.3, 0.5, -0.8).normalized();
  std::vector<uint8_t> look{};
  std::set<ImageId> fetched{};

  TwoDrives() {
    Random random(1);
    look = testing::RandomDescriptor(random);
    for (uint32_t i = 0; i < 2 * kOfEach; ++i) {
      ImageRecord& image = manifest.images.emplace_back();
      image.id = ImageId(i);
      image.drive = i % 2;
      image.prior.position_in_enu = Eigen::Vector3d(0.5 * kStep_m * i, 0.0, 0.0);
    }
  }

  std::vector<Carrier> Find() {
    const auto carriers = FindCarriers(manifest, [&](ImageId id) -> absl::StatusOr<Features> {
      fetched.insert(id);
      Random random(id.value + 9);
      Features features{.camera = {2048, 1024}};
      if (manifest.At(id).drive == 0) testing::AppendFeature(features, mark, look);
      for (int i = 0; i < 500; ++i)
        testing::AppendFeature(
            features, testing::RandomDirection(random), testing::RandomDescriptor(random));
      return features;
    });
    EXPECT_TRUE(carriers.ok()) << carriers.status();
    return *carriers;
  }
};

TEST(FindCarriers, AreThoseOfTheDrivesThatShowOne) {
  TwoDrives drives;
  const std::vector<Carrier> carriers = drives.Find();
  ASSERT_EQ(carriers.size(), 1U);
  EXPECT_EQ(carriers[0].cells, std::vector<uint32_t>{SphereCell(drives.mark, kCarrierCells)});
  ASSERT_EQ(carriers[0].images.size(), kOfEach);
  for (uint32_t i = 0; i < kOfEach; ++i) EXPECT_EQ(carriers[0].images[i], ImageId(2 * i));
}

TEST(FindCarriers, LooksAtFewPanoramasHoweverLongTheDrive) {
  TwoDrives drives;
  drives.Find();
  EXPECT_EQ(drives.fetched.size(), 2U * 24U);
  EXPECT_TRUE(drives.fetched.contains(ImageId(0)));
  EXPECT_GE(drives.fetched.rbegin()->value, 2 * kOfEach - 8) << "all along it";
}

TEST(FindCarriers, AreNoneWhereNothingTellsThatTheCameraMoved) {
  TwoDrives drives;
  for (ImageRecord& image : drives.manifest.images) image.prior.position_in_enu.reset();
  EXPECT_THAT(drives.Find(), IsEmpty());
  EXPECT_THAT(drives.fetched, IsEmpty());
}

TEST(FindCarriers, HandsOnWhatWentWrong) {
  TwoDrives drives;
  const auto carriers = FindCarriers(drives.manifest, [](ImageId) -> absl::StatusOr<Features> {
    return absl::UnavailableError("gone");
  });
  EXPECT_TRUE(absl::IsUnavailable(carriers.status()));
}

}  // namespace
}  // namespace orbweave
