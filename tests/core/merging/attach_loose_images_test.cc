// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/attach_loose_images.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

/// Images along a street to the east, 3 m apart, all with GNSS.
ImageManifest ImagesOfStreet(uint32_t num_images) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.prior.position_in_enu = Eigen::Vector3d(3.0 * i, 1.0, 2.0);
  }
  return manifest;
}

/// Holds images [begin, end); image i is turned by i hundredths of a radian about z.
FinalisedWorld World(uint32_t begin, uint32_t end, bool georeferenced) {
  FinalisedWorld world;
  for (uint32_t i = begin; i < end; ++i) {
    world.images[ImageId(i)].cam_from_world.rotation =
        RotationFromVector(Eigen::Vector3d(0.0, 0.0, 0.01 * i));
  }
  world.report.gnss.used = georeferenced;
  return world;
}

double TurnAboutZ(const RegisteredImage& image) {
  return VectorFromRotation(image.cam_from_world.rotation).z();
}

TEST(AttachLooseImages, PutsMissingImagesAtTheirPositionsTurnedAsTheirNeighbours) {
  const ImageManifest manifest = ImagesOfStreet(12);
  std::vector<FinalisedWorld> worlds = {World(2, 5, true)};
  for (uint32_t i = 9; i < 11; ++i) worlds[0].images.merge(World(i, i + 1, true).images);
  AttachLooseImages(manifest, {}, worlds);
  ASSERT_EQ(worlds[0].images.size(), 12U);
  for (const auto& [id, image] : worlds[0].images) {
    const bool was_there = (id.value >= 2 && id.value < 5) || id.value == 9 || id.value == 10;
    EXPECT_EQ(image.loose, !was_there) << id.value;
    if (was_there) continue;
    EXPECT_LT((image.cam_from_world.Centre() - *manifest.At(id).prior.position_in_enu).norm(),
              1e-9);
  }
  EXPECT_NEAR(TurnAboutZ(worlds[0].images[ImageId(0)]), 0.02, 1e-12);
  EXPECT_NEAR(TurnAboutZ(worlds[0].images[ImageId(6)]), 0.04, 1e-12);
  EXPECT_NEAR(TurnAboutZ(worlds[0].images[ImageId(7)]), 0.09, 1e-12);
  EXPECT_NEAR(TurnAboutZ(worlds[0].images[ImageId(11)]), 0.10, 1e-12);
}

TEST(AttachLooseImages, StandsLevelWithItsHeadingWhereNobodyOfTheDriveIsObserved) {
  ImageManifest manifest = ImagesOfStreet(3);
  manifest.images[2].drive = 1;
  manifest.images[2].prior.heading_deg = 90.0;
  std::vector<FinalisedWorld> worlds = {World(0, 2, true)};
  AttachLooseImages(manifest, {}, worlds);
  const Rigid3& camera = worlds[0].images.at(ImageId(2)).cam_from_world;
  EXPECT_LT((camera.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(), 1e-12)
      << "it looks to the east";
  EXPECT_LT((camera.rotation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitY()).norm(), 1e-12)
      << "up is against y";
}

TEST(AttachLooseImages, TakesOffWhatTheirDriveHasWrong) {
  ImageManifest manifest = ImagesOfStreet(6);
  for (const uint32_t i : {3U, 4U, 5U}) manifest.images[i].drive = 1;
  std::vector<FinalisedWorld> worlds = {World(0, 2, true)};
  worlds[0].images.merge(World(3, 5, true).images);
  const std::vector<DriveErrors> errors = {{.drive = 1, .offset_m = {0.0, 0.0, 47.0}}};
  AttachLooseImages(manifest, errors, worlds);
  const auto error_m = [&](uint32_t i) {
    return (worlds[0].images.at(ImageId(i)).cam_from_world.Centre() -
            *manifest.images[i].prior.position_in_enu)
        .eval();
  };
  EXPECT_LT(error_m(2).norm(), 1e-9) << "its drive is right";
  EXPECT_LT((error_m(5) + Eigen::Vector3d(0.0, 0.0, 47.0)).norm(), 1e-9);
}

TEST(AttachLooseImages, TakesImagesOfAWorldThatIsNotGeoreferencedButNotOfOneThatIs) {
  const ImageManifest manifest = ImagesOfStreet(9);
  std::vector<FinalisedWorld> worlds = {World(0, 4, true), World(4, 7, true), World(7, 9, false)};
  AttachLooseImages(manifest, {}, worlds);
  EXPECT_EQ(worlds[0].images.size(), 6U);
  EXPECT_TRUE(worlds[0].images.at(ImageId(8)).loose);
  EXPECT_EQ(worlds[1].images.size(), 3U);
  EXPECT_EQ(worlds[2].images.size(), 2U) << "its own model stays";
}

TEST(AttachLooseImages, LeavesOutImagesWithoutPositionAndWorldsWithoutGnss) {
  ImageManifest manifest = ImagesOfStreet(4);
  manifest.images[3].prior.position_in_enu.reset();
  std::vector<FinalisedWorld> worlds = {World(0, 3, true)};
  AttachLooseImages(manifest, {}, worlds);
  EXPECT_EQ(worlds[0].images.size(), 3U);
  std::vector<FinalisedWorld> free = {World(0, 2, false)};
  AttachLooseImages(manifest, {}, free);
  EXPECT_EQ(free[0].images.size(), 2U);
  std::vector<FinalisedWorld> none;
  AttachLooseImages(manifest, {}, none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace orbweave
