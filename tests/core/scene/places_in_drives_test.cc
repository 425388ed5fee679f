// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/scene/places_in_drives.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

/// Two drives, 0 2 4 and 1 3; the second was taken backwards.
ImageManifest TwoDrives() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 5; ++i) {
    ImageRecord image{.id = ImageId(i), .drive = i % 2};
    if (i % 2 == 1) image.capture_time_s = 100.0 - i;
    manifest.images.push_back(image);
  }
  return manifest;
}

TEST(PlacesInDrives, AreThoseOfTheSequence) {
  const PlacesInDrives places(TwoDrives());
  EXPECT_EQ(places.PlaceOf(ImageId(4)), 2U);
  EXPECT_EQ(places.PlaceOf(ImageId(1)), 1U);
  EXPECT_EQ(places.PlaceOf(ImageId(3)), 0U);
}

TEST(PlacesInDrives, LeadFromOneToTheNextAndEndWithTheDrive) {
  const PlacesInDrives places(TwoDrives());
  EXPECT_EQ(places.After(ImageId(0)), ImageId(2));
  EXPECT_EQ(places.After(ImageId(3)), ImageId(1));
  EXPECT_EQ(places.After(ImageId(1)), std::nullopt);
  EXPECT_EQ(places.Before(ImageId(1)), ImageId(3));
  EXPECT_EQ(places.Before(ImageId(0)), std::nullopt);
}

TEST(PlacesInDrives, CountStepsWithinADriveAlone) {
  const PlacesInDrives places(TwoDrives());
  EXPECT_EQ(places.StepsBetween({ImageId(0), ImageId(4)}), 2U);
  EXPECT_EQ(places.StepsBetween({ImageId(1), ImageId(3)}), 1U);
  EXPECT_EQ(places.StepsBetween({ImageId(0), ImageId(1)}), std::nullopt);
}

TEST(PlacesInDrives, CountCapturesThatWereTakenOut) {
  ImageManifest manifest;
  for (const char* name : {"7.jpg", "8.jpg", "9.jpg", "14.jpg", "15.jpg"}) {
    const ImageId id(static_cast<uint32_t>(manifest.images.size()));
    manifest.images.push_back({.id = id, .name = name});
  }
  manifest.images.push_back({.id = ImageId(5), .name = "16.jpg", .drive = 1});
  const PlacesInDrives places(manifest);
  EXPECT_EQ(places.CapturesBetween({ImageId(0), ImageId(4)}), 8U);
  EXPECT_EQ(places.StepsBetween({ImageId(0), ImageId(4)}), 4U);
  EXPECT_EQ(places.CapturesBetween({ImageId(4), ImageId(5)}), std::nullopt);
}

TEST(PlacesInDrives, TellStretchesThatGnssHasApart) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 8; ++i) {
    manifest.images.push_back({.id = ImageId(i)});
    manifest.images.back().prior.position_in_enu =
        Eigen::Vector3d(8.0 * i + (i < 4 ? 0.0 : 200.0), 0.0, 0.0);
  }
  const PlacesInDrives places(manifest);
  EXPECT_TRUE(places.AreOfOneStretch({ImageId(0), ImageId(3)}));
  EXPECT_TRUE(places.AreOfOneStretch({ImageId(4), ImageId(7)}));
  EXPECT_FALSE(places.AreOfOneStretch({ImageId(3), ImageId(4)}));
  EXPECT_EQ(places.StepsBetween({ImageId(3), ImageId(4)}), 1U);
  manifest.images[2].drive = 1;
  EXPECT_FALSE(PlacesInDrives(manifest).AreOfOneStretch({ImageId(1), ImageId(2)}));
}

}  // namespace
}  // namespace orbweave
