// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/drop_off_scale_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/mapping/checks/borne_out_images.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

constexpr uint32_t kImages = 20;

std::vector<ImageSlot> Images(ImageSlot first, ImageSlot end) {
  std::vector<ImageSlot> images;
  for (ImageSlot image = first; image < end; ++image) images.push_back(image);
  return images;
}

/// A straight street of 20 panoramas, 8 m apart, each with pairs to the four on either side.
StreetFixture Street() {
  std::vector<Eigen::Vector3d> centres;
  for (uint32_t i = 0; i < kImages; ++i) centres.emplace_back(8.0 * i, 0.0, 0.0);
  return StreetFixture({.centres = centres, .points_per_metre = 8, .reach_m = 30.0, .window = 4});
}

/// Some images and, if it is to, all that they see, on another scale about the first of them.
void Shrink(const std::vector<ImageSlot>& images,
            double scale,
            MappingState& state,
            bool with_points = true) {
  const Eigen::Vector3d pivot = state.Centre(images.front());
  const auto shrunk = [&](const Eigen::Vector3d& place) -> Eigen::Vector3d {
    return pivot + scale * (place - pivot);
  };
  for (PointIndex p = 0; p < state.EndOfPoints() && with_points; ++p) {
    const auto is_one_of_them = [&](ImageSlot image) {
      return std::ranges::find(images, image) != images.end();
    };
    if (std::ranges::any_of(ImagesThatSee(state, p), is_one_of_them))
      state.SetPosition(p, shrunk(state.Point(p).position));
  }
  for (const ImageSlot image : images) {
    state.SetPose(
        image, Rigid3::FromCentre(state.CamFromWorld(image).rotation, shrunk(state.Centre(image))));
  }
}

TEST(DropOffScaleImages, LeavesARightModel) {
  const StreetFixture street = Street();
  MappingState state = street.TriangulatedStateWith(Images(0, kImages));
  EXPECT_THAT(ImagesOffScale(state), IsEmpty());
  EXPECT_THAT(DropOffScaleImages(state), IsEmpty());
  EXPECT_EQ(state.Registered().size(), kImages);
}

TEST(DropOffScaleImages, TakesOutTheSmallerPartWhateverShrank) {
  const StreetFixture street = Street();
  for (const auto& [shrunk, smaller] :
       {std::pair(Images(12, 20), Images(12, 20)), std::pair(Images(7, 20), Images(0, 7))}) {
    MappingState state = street.TriangulatedStateWith(Images(0, kImages));
    Shrink(shrunk, 1e-3, state);
    EXPECT_THAT(DropOffScaleImages(state), ElementsAreArray(smaller));
    EXPECT_EQ(state.Registered().size(), kImages - smaller.size());
    EXPECT_THAT(DropOffScaleImages(state), IsEmpty());
  }
}

TEST(DropOffScaleImages, WhatHangsAtThemAloneGoesAlong) {
  const StreetFixture street = Street();
  MappingState state = street.TriangulatedStateWith(Images(0, kImages));
  const auto is_across = [&](PointIndex p) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, p);
    return !images.empty() && images.front() < 12 && images.back() >= 16;
  };
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    if (is_across(p)) state.RemovePoint(p);
  }
  Shrink(Images(12, 16), 1e-3, state);
  EXPECT_THAT(DropOffScaleImages(state), ElementsAreArray(Images(12, 20)));
}

TEST(DropOffScaleImages, RoomsBesideAStreetAreOfOneWorld) {
  const StreetFixture street = Street();
  MappingState state = street.TriangulatedStateWith(Images(0, kImages));
  Shrink(Images(12, 20), 1.0 / 25.0, state);
  EXPECT_THAT(DropOffScaleImages(state), IsEmpty());
}

TEST(DropOffScaleImages, ACameraThatStandsSeesAsFarAsEver) {
  const StreetFixture street = Street();
  MappingState state = street.TriangulatedStateWith(Images(0, kImages));
  Shrink(Images(12, 20), 1e-6, state, false);
  EXPECT_THAT(DropOffScaleImages(state), IsEmpty());
}

TEST(DropOffScaleImages, AreNotCountedForAModel) {
  const StreetFixture street = Street();
  MappingState state = street.TriangulatedStateWith(Images(0, kImages));
  EXPECT_EQ(BorneOutImages(state), kImages);
  Shrink(Images(12, 20), 1e-3, state);
  EXPECT_EQ(BorneOutImages(state), 12.0);
}

TEST(DropOffScaleImages, NothingIsOffScaleInAModelWithoutImagesOrPoints) {
  const StreetFixture street = Street();
  MappingState none = street.StateWith({});
  EXPECT_THAT(DropOffScaleImages(none), IsEmpty());
  MappingState pointless = street.StateWith(Images(0, 3));
  EXPECT_THAT(DropOffScaleImages(pointless), IsEmpty());
  MappingState single = street.StateWith(Images(0, 1));
  EXPECT_THAT(DropOffScaleImages(single), IsEmpty());
}

}  // namespace
}  // namespace orbweave
