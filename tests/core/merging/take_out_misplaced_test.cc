// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <utility>
#include <vector>

#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/adjust_globally.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

using testing::AdjustGlobally;
using testing::GloballyAdjusted;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TrueModel;

constexpr ImageId kImage{9};
constexpr std::array<ImageId, 2> kNeighbours{ImageId(10), ImageId(11)};

/// A street whose GNSS knows half a metre.
class Street {
 public:
  Street()
      : corridor_(
            MakeCorridor({.panoramas = 20, .features_per_panorama = 200, .gnss_sigma_m = 0.0})) {
    for (ImageRecord& image : corridor_.manifest.images) {
      image.prior.position_in_enu = Centre(image.id);
      image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = 0.5;
    }
  }

  [[nodiscard]] Eigen::Vector3d Centre(ImageId image) const {
    return corridor_.cams_from_world[image.value].Centre();
  }
  [[nodiscard]] Reconstruction Right() const { return TrueModel(corridor_); }
  PosePrior& Prior(ImageId image) { return corridor_.manifest.images[image.value].prior; }
  /// Positions that are off by so much, each by its own.
  void Measure(double gnss_sigma_m) {
    std::mt19937 random(1);
    std::normal_distribution<double> error_m(0.0, gnss_sigma_m);
    for (ImageRecord& image : corridor_.manifest.images) {
      for (double& coordinate_m : *image.prior.position_in_enu) coordinate_m += error_m(random);
      image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = gnss_sigma_m;
    }
  }
  void ForgetPositions() {
    for (ImageRecord& image : corridor_.manifest.images) image.prior.position_in_enu.reset();
  }
  [[nodiscard]] GloballyAdjusted Adjust(const Reconstruction& model) const {
    return AdjustGlobally(model, corridor_.manifest, {}, {}, {}).value();
  }

 private:
  Corridor corridor_;
};

/// The image as its neighbours would have it if all that it sees stood `by` further along, and
/// nobody else: houses repeat.
Reconstruction Fooled(Reconstruction model,
                      ImageId image,
                      const std::array<ImageId, 2>& neighbours,
                      const Eigen::Vector3d& by) {
  constexpr uint32_t kOwnFeatures = 1U << 20U;
  Rigid3& pose = model.images.at(image).cam_from_world;
  pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + by);
  std::vector<Track> repeated;
  for (Track& track : model.tracks) {
    const auto seen = std::ranges::find_if(
        track.observations, [&](const Observation& each) { return each.ref.image == image; });
    if (seen == track.observations.end()) continue;
    Track& other = repeated.emplace_back();
    other.point_in_world = track.point_in_world + by;
    other.observations.push_back(*seen);
    track.observations.erase(seen);
    const auto feature = kOwnFeatures + static_cast<uint32_t>(repeated.size());
    for (const ImageId neighbour : neighbours) {
      const Eigen::Vector3d ray = model.images.at(neighbour).cam_from_world * other.point_in_world;
      other.observations.push_back({.ref = {neighbour, feature},
                                    .bearing = ray.normalized(),
                                    .sigma_rad = other.observations.front().sigma_rad});
    }
  }
  std::ranges::move(repeated, std::back_inserter(model.tracks));
  std::erase_if(model.tracks, [](const Track& track) { return track.observations.size() < 2; });
  model.SortTracks();
  return model;
}

/// Without the images [first, last).
Reconstruction Without(uint32_t first, uint32_t last, Reconstruction model) {
  for (uint32_t image = first; image < last; ++image) model.images.erase(ImageId(image));
  for (Track& track : model.tracks) {
    std::erase_if(track.observations,
                  [&](const Observation& each) { return !model.images.contains(each.ref.image); });
  }
  std::erase_if(model.tracks, [](const Track& track) { return track.observations.size() < 2; });
  return model;
}

TEST(TakeOutMisplaced, WhatNeitherGnssNorOthersHaveThere) {
  const Street street;
  const Eigen::Vector3d by = street.Centre(ImageId(3)) - street.Centre(kImage);
  const GloballyAdjusted adjusted = street.Adjust(Fooled(street.Right(), kImage, kNeighbours, by));
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_THAT(adjusted.report.weak_images[0].reason, HasSubstr("misplaced"));
  EXPECT_FALSE(adjusted.reconstruction.images.contains(kImage));
  EXPECT_EQ(adjusted.reconstruction.images.size(), 19U);
  EXPECT_THAT(adjusted.report.gnss.outliers, IsEmpty());
}

TEST(TakeOutMisplaced, WhatStandsBesideItsOnlyNeighbourButNotByGnss) {
  constexpr ImageId kEnd{10};  // those before it are lost
  constexpr std::array<ImageId, 2> kBeside{ImageId(11), ImageId(12)};
  Street street;
  street.Measure(0.2);
  const Eigen::Vector3d by = 0.9 * (street.Centre(kBeside[0]) - street.Centre(kEnd));
  const Reconstruction fooled = Without(5, 10, Fooled(street.Right(), kEnd, kBeside, by));
  const GloballyAdjusted adjusted = street.Adjust(fooled);
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_THAT(adjusted.report.weak_images[0].reason,
              HasSubstr("of a usual step from pano_000011.jpg, its only neighbour: misplaced"));
  EXPECT_FALSE(adjusted.reconstruction.images.contains(kEnd));
  street.ForgetPositions();
  EXPECT_THAT(street.Adjust(fooled).report.weak_images, IsEmpty()) << "it may have started there";
}

TEST(TakeOutMisplaced, NotWhereGnssAloneIsOff) {
  Street street;
  *street.Prior(kImage).position_in_enu += Eigen::Vector3d(25.0, 30.0, 0.0);
  const GloballyAdjusted adjusted = street.Adjust(street.Right());
  EXPECT_THAT(adjusted.report.weak_images, IsEmpty());
  EXPECT_EQ(adjusted.report.gnss.outliers.size(), 1U);
}

TEST(TakeOutMisplaced, NotWhereNoGnssSaysSo) {
  Street street;
  street.ForgetPositions();
  const Eigen::Vector3d by = street.Centre(ImageId(3)) - street.Centre(kImage);
  const GloballyAdjusted adjusted = street.Adjust(Fooled(street.Right(), kImage, kNeighbours, by));
  EXPECT_THAT(adjusted.report.weak_images, IsEmpty());
  const auto missed = std::ranges::find(adjusted.report.checks, "missed_points", &CrossCheck::name);
  ASSERT_NE(missed, adjusted.report.checks.end());
  EXPECT_EQ(missed->level, CheckLevel::kDoubtful);
}

}  // namespace
}  // namespace orbweave
