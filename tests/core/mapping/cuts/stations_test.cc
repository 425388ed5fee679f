// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/stations.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/mapping/cuts/parts_of_one_scale.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

constexpr double kAngle_rad = 0.01;
constexpr uint32_t kMoving = 8;  ///< before a stop, and behind it
constexpr uint32_t kStanding = 30;
constexpr uint32_t kImages = kMoving + kStanding + kMoving;

/// 8 m apart but for a stop, where the camera drifts by some millimetres.
std::vector<Eigen::Vector3d> WalkWithAStop() {
  std::vector<Eigen::Vector3d> centres = StraightWalk(2 * kMoving, 8.0);
  const Eigen::Vector3d stop = centres[kMoving];
  std::vector<Eigen::Vector3d> standing;
  for (uint32_t i = 0; i < kStanding; ++i) standing.emplace_back(stop.x() - 4.0, 0.0, 0.0002 * i);
  centres.insert(centres.begin() + kMoving, standing.begin(), standing.end());
  return centres;
}

StreetFixture StreetWithAStop() {
  return StreetFixture({.centres = WalkWithAStop(), .window = kStanding, .random_rotations = true});
}

TEST(Stations, AStopIsOneAndEveryOtherImageAnother) {
  const StreetFixture street = StreetWithAStop();
  const MappingState state = street.TriangulatedStateWith(FirstImages(kImages));
  const Stations stations(state, kAngle_rad);
  for (ImageSlot image = 0; image < kImages; ++image) {
    const bool stands = image >= kMoving && image < kMoving + kStanding;
    EXPECT_EQ(stations.FirstOf(image), stands ? kMoving : image);
  }
  EXPECT_EQ(stations.RankOf(kMoving + 3), kMoving);
  EXPECT_EQ(stations.RankOf(kImages - 1), 2 * kMoving);
}

TEST(Stations, ASlowCameraHasStationsAsFarApartAsAskedFor) {
  const StreetFixture street({.centres = StraightWalk(40, 0.02)});
  const MappingState state = street.TriangulatedStateWith(FirstImages(40));
  const Stations stations(state, kAngle_rad);
  EXPECT_EQ(stations.FirstOf(1), 0U);
  EXPECT_GT(stations.RankOf(39), 1U);
  EXPECT_LT(stations.RankOf(39), 20U);
}

TEST(PartsOfOneScale, AStopTearsNothing) {
  const StreetFixture street = StreetWithAStop();
  const MappingState state = street.TriangulatedStateWith(FirstImages(kImages));
  EXPECT_EQ(PartsOfOneScale(state, {}).size(), 1U);
}

}  // namespace
}  // namespace orbweave
