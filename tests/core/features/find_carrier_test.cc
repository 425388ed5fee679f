// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/find_carrier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "core/features/hide_carrier.h"
#include "core/geometry/sphere_cells.h"
#include "core/scene/carrier.h"
#include "tests/support/random_features.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using ::testing::IsEmpty;

constexpr size_t kPanoramas = 12;
constexpr size_t kOfCarrier = 300;
constexpr size_t kOfScene = 3000;
constexpr double kTrembles_rad = 1e-3;

struct Drive {
  std::vector<PlacedPanorama> panoramas{};
  std::set<uint32_t> cells{};  ///< in which features of the carrier lie
};

/// A drive along a street of random points, behind a bonnet all round the camera's foot that looks
/// a little different in every panorama.
Drive AlongAStreet(double step_m, size_t of_carrier) {
  Random random(7);
  std::vector<std::pair<Vector3d, std::vector<uint8_t>>> carrier;
  Drive drive;
  for (size_t i = 0; i < of_carrier; ++i) {
    Vector3d bearing = testing::RandomDirection(random);
    bearing.y() = std::abs(bearing.y());
    carrier.emplace_back(bearing, testing::RandomDescriptor(random));
    drive.cells.insert(SphereCell(bearing, kCarrierCells));
  }
  for (size_t i = 0; i < kPanoramas; ++i) {
    PlacedPanorama panorama{.features = {.camera = {2048, 1024}},
                            .position_in_enu = {step_m * static_cast<double>(i), 5.0},
                            .sigma_m = 1.0};
    for (const auto& [bearing, descriptor] : carrier)
      testing::AppendFeature(panorama.features,
                             testing::WithNoise(random, bearing, kTrembles_rad),
                             testing::ChangedDescriptor(random, descriptor, 5.0));
    for (size_t k = 0; k < kOfScene; ++k)
      testing::AppendFeature(
          panorama.features, testing::RandomDirection(random), testing::RandomDescriptor(random));
    drive.panoramas.push_back(std::move(panorama));
  }
  return drive;
}

size_t FeaturesOfCarrierIn(const Drive& drive, const std::vector<uint32_t>& cells) {
  const Features& features = drive.panoramas.front().features;
  size_t found = 0;
  for (FeatureIndex i = 0; i < kOfCarrier; ++i)
    found += std::ranges::binary_search(cells, SphereCell(features.Bearing(i), kCarrierCells));
  return found;
}

TEST(FindCarrier, FindsWhereItShowsAndNothingElse) {
  const Drive drive = AlongAStreet(10.0, kOfCarrier);
  const std::vector<uint32_t> cells = FindCarrier(drive.panoramas);
  EXPECT_TRUE(std::ranges::is_sorted(cells));
  EXPECT_GE(FeaturesOfCarrierIn(drive, cells), kOfCarrier * 95 / 100);
  // Some tremble into the next cell.
  EXPECT_LE(cells.size(), drive.cells.size() * 110 / 100);
}

TEST(FindCarrier, TheSeamIsNowhereSpecial) {
  Drive drive = AlongAStreet(10.0, kOfCarrier);
  const size_t before = FindCarrier(drive.panoramas).size();
  for (PlacedPanorama& panorama : drive.panoramas) {
    for (Keypoint& keypoint : panorama.features.keypoints)
      keypoint.x_px = std::fmod(keypoint.x_px + 1024.0F, 2048.0F);
  }
  EXPECT_EQ(FindCarrier(drive.panoramas).size(), before);
}

TEST(FindCarrier, IsSilentWhereNothingIsFixed) {
  EXPECT_THAT(FindCarrier(AlongAStreet(10.0, 0).panoramas), IsEmpty());
  Drive turning = AlongAStreet(10.0, kOfCarrier);
  Random random(3);
  for (PlacedPanorama& panorama : turning.panoramas) {
    const float turned_px = static_cast<float>(random.Uniform(0.0, 2048.0));
    for (Keypoint& keypoint : panorama.features.keypoints)
      keypoint.x_px = std::fmod(keypoint.x_px + turned_px, 2048.0F);
  }
  EXPECT_THAT(FindCarrier(turning.panoramas), IsEmpty());
}

TEST(FindCarrier, IsSilentAlongAKerb) {
  Drive drive = AlongAStreet(10.0, 0);
  Random random(11);
  const std::vector<uint8_t> look = testing::RandomDescriptor(random);
  for (PlacedPanorama& panorama : drive.panoramas) {
    for (int k = 0; k < 200; ++k) {  // seen at the same angles from wherever one drives
      const double along_m = random.Uniform(-8.0, 8.0);
      testing::AppendFeature(
          panorama.features, {3.0, 2.0, along_m}, testing::ChangedDescriptor(random, look, 5.0));
    }
  }
  EXPECT_THAT(FindCarrier(drive.panoramas), IsEmpty());
}

TEST(FindCarrier, IsSilentWhereTheCameraMayHaveStood) {
  EXPECT_THAT(FindCarrier(AlongAStreet(0.5, kOfCarrier).panoramas), IsEmpty());
  Drive vague = AlongAStreet(10.0, kOfCarrier);
  for (PlacedPanorama& panorama : vague.panoramas) panorama.sigma_m = 30.0;
  EXPECT_THAT(FindCarrier(vague.panoramas), IsEmpty());
  EXPECT_THAT(FindCarrier({}), IsEmpty());
}

TEST(FindCarrier, IsSilentOfFeaturesThatNobodyDescribed) {
  Drive drive = AlongAStreet(10.0, kOfCarrier);
  for (PlacedPanorama& panorama : drive.panoramas) panorama.features.descriptors.clear();
  EXPECT_THAT(FindCarrier(drive.panoramas), IsEmpty());
}

TEST(FindCarrier, TwoPairsAreNotEnough) {
  Drive drive = AlongAStreet(100.0, kOfCarrier);
  drive.panoramas.resize(2);
  EXPECT_THAT(FindCarrier(drive.panoramas), IsEmpty());
}

TEST(HideCarrier, LeavesTheOthersAsTheyAre) {
  Random random(5);
  Features features{.camera = {2048, 1024}};
  for (int i = 0; i < 500; ++i) {
    testing::AppendFeature(
        features, testing::RandomDirection(random), testing::RandomDescriptor(random));
    features.view.push_back(i < 400 ? 0 : 1);
  }
  std::vector<uint32_t> cells(kNumCarrierCells / 2);
  for (uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;  // above the horizon
  const SceneFeatures scene = HideCarrier(features, cells);
  ASSERT_EQ(scene.features.size(), scene.index.size());
  EXPECT_TRUE(std::ranges::is_sorted(scene.index));
  std::set<FeatureIndex> left(scene.index.begin(), scene.index.end());
  for (FeatureIndex i = 0; i < features.size(); ++i)
    EXPECT_EQ(left.contains(i), features.Bearing(i).y() >= 0.0) << i;
  for (FeatureIndex i = 0; i < scene.features.size(); ++i) {
    const FeatureIndex own = scene.index[i];
    EXPECT_EQ(scene.features.keypoints[i].x_px, features.keypoints[own].x_px);
    EXPECT_EQ(scene.features.sigma_rad[i], features.sigma_rad[own]);
    EXPECT_EQ(scene.features.view[i], features.view[own]);
    EXPECT_TRUE(std::equal(scene.features.Descriptor(i),
                           scene.features.Descriptor(i) + kDescriptorSize,
                           features.Descriptor(own)));
  }
  EXPECT_EQ(HideCarrier(features, {}).features.descriptors, features.descriptors);
}

}  // namespace
}  // namespace orbweave
