// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/tying_rays.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = 16;

StreetFixture StreetOf(std::vector<Eigen::Vector3d> centres) {
  return StreetFixture({.centres = std::move(centres),
                        .points_per_metre = 8,
                        .reach_m = 30.0,
                        .window = kImages,
                        .random_rotations = true});
}

/// Two drives along a street, whose images lie between each other's: two lines.
class TwoDrives {
 public:
  TwoDrives() : street_(StreetOf(StraightWalk(kImages, 4.0))) {
    for (uint32_t i = 0; i < kImages; ++i) street_.world.problem.images[i].drive = i % 2;
  }
  [[nodiscard]] MappingState With(const std::vector<ImageSlot>& images) const {
    return street_.StateWith(images);
  }

 private:
  StreetFixture street_;
};

/// Of the steps behind all images.
std::map<ImageSlot, uint32_t> TiesIn(const MappingState& state) {
  const std::vector<ImageSlot>& images = state.Registered();
  return CountTyingRays({state, {}}, {images.begin(), images.end()});
}

TEST(TyingRays, AreNoneWhereACameraPassesOnce) {
  const TornStreet street;
  for (const auto& [image, rays] : TiesIn(street.Right())) EXPECT_EQ(rays, 0U) << image;
}

TEST(TyingRays, AreThoseOfAnotherDrive) {
  const TwoDrives street;
  const auto ties = TiesIn(street.With(FirstImages(kImages)));
  for (ImageSlot image = 0; image + 2 < kImages; ++image) EXPECT_GT(ties.at(image), 25U) << image;
}

TEST(TyingRays, AreThoseOfTheWayBack) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(kImages / 2, 8.0);
  for (uint32_t i = kImages / 2; i > 0; --i)
    centres.emplace_back(centres[i - 1] + Eigen::Vector3d(1.0, 2.0, 0.0));
  const StreetFixture street = StreetOf(centres);
  const auto ties = TiesIn(street.StateWith(FirstImages(kImages)));
  for (const ImageSlot image : {0U, 1U, 2U, 3U, 11U, 12U, 13U, 14U})
    EXPECT_GT(ties.at(image), 25U) << image;
}

TEST(TyingRays, AreCountedWhereTheyAreAskedFor) {
  const TwoDrives street;
  const MappingState state = street.With(FirstImages(kImages));
  const auto all = TiesIn(state);
  const auto some = CountTyingRays({state, {}}, {4, 7});
  EXPECT_EQ(some, (std::map<ImageSlot, uint32_t>{{4, all.at(4)}, {7, all.at(7)}}));
  EXPECT_TRUE(CountTyingRays({state, {}}, {}).empty());
}

/// What is behind a tear of one drive stands beside the other one as it should not.
TEST(TyingRays, DoNotTieWhatIsTorn) {
  const TwoDrives street;
  const auto right = TiesIn(street.With(FirstImages(kImages)));
  MappingState torn = street.With(FirstImages(kImages));
  for (ImageSlot image = 8; image < kImages; image += 2)
    TornStreet::Move(image, {4.0, 0.0, 0.0}, torn);
  EXPECT_LT(TiesIn(torn).at(6), right.at(6) / 3);
}

/// A line that knows one side alone says nothing of the step to the other.
TEST(TyingRays, AreNoneWhereTheOtherDriveEnds) {
  const TwoDrives street;
  std::vector<ImageSlot> images;
  for (ImageSlot image = 0; image < kImages; ++image) {
    if (image % 2 == 0 || image > 12) images.push_back(image);
  }
  const auto ties = TiesIn(street.With(images));
  EXPECT_EQ(ties.at(0), 0U);
  EXPECT_EQ(ties.at(2), 0U);
}

}  // namespace
}  // namespace orbweave
