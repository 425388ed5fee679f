// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/reconsider_images.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

constexpr uint32_t kNumPlaced = 7;
constexpr ImageSlot kBeyondNeighbour = 3;

/// A walk whose fourth image stands beyond its neighbour, with the points that it saw from there.
struct WronglyPlaced {
  WronglyPlaced() {
    const Eigen::Vector3d wrong = truth.Centre() - 2.0 * (truth.Centre() - state.Centre(2));
    state.SetPose(kBeyondNeighbour, Rigid3::FromCentre(truth.rotation, wrong));
  }
  [[nodiscard]] double Error_m() const {
    return (state.Centre(kBeyondNeighbour) - truth.Centre()).norm();
  }
  absl::Status Reconsider() { return ReconsiderImages(state, {}, limits, log, {}); }

  StreetFixture street{
      {.centres = StraightWalk(kNumPlaced, 3.0), .noise_px = 0.2, .random_rotations = true}};
  MappingState state = street.TriangulatedStateWith(FirstImages(kNumPlaced));
  Rigid3 truth = street.world.cams_from_world[kBeyondNeighbour];
  RegistrationLimits limits{};
  RegistrationLog log = RegistrationLog(kNumPlaced);
};

TEST(ReconsiderImages, PutsAnImageBackThatStandsBeyondItsNeighbour) {
  WronglyPlaced walk;
  ASSERT_GT(walk.Error_m(), 5.0);
  ASSERT_TRUE(walk.Reconsider().ok());
  EXPECT_LT(walk.Error_m(), 0.02);
  EXPECT_EQ(walk.state.Registered().size(), kNumPlaced);
  EXPECT_EQ(walk.log[kBeyondNeighbour].num_reconsidered, 1);
  EXPECT_GT(walk.state.NumObservations(kBeyondNeighbour), 50U);
}

TEST(ReconsiderImages, PutsAnImageBackThatWentTooFarAlongTheStreet) {
  // No pair contradicts this: along the street the directions of all pairs are as before.
  WronglyPlaced walk;
  const Eigen::Vector3d step = walk.truth.Centre() - walk.state.Centre(2);
  walk.state.SetPose(kBeyondNeighbour,
                     Rigid3::FromCentre(walk.truth.rotation, walk.truth.Centre() + 0.4 * step));
  ASSERT_TRUE(walk.Reconsider().ok());
  EXPECT_LT(walk.Error_m(), 0.02);
  EXPECT_EQ(walk.log[kBeyondNeighbour].num_reconsidered, 1);
}

TEST(ReconsiderImages, LeavesARightModelAsItIs) {
  const StreetFixture street({.centres = StraightWalk(kNumPlaced, 3.0), .noise_px = 0.5});
  MappingState state = street.TriangulatedStateWith(FirstImages(kNumPlaced));
  RegistrationLog log(kNumPlaced);
  const size_t points = state.NumPoints();
  ASSERT_TRUE(ReconsiderImages(state, {}, {}, log, {}).ok());
  EXPECT_EQ(state.NumPoints(), points);
  for (ImageSlot image = 0; image < kNumPlaced; ++image) {
    EXPECT_EQ(log[image].num_reconsidered, 0);
    EXPECT_EQ(state.Centre(image), street.world.cams_from_world[image].Centre());
  }
}

TEST(ReconsiderImages, KeepsAnImageThatFindsNoOtherPlaceAndGivesUpAfterTwo) {
  WronglyPlaced walk;
  walk.limits.min_inliers = 100000;
  const double error_m = walk.Error_m();
  for (int time = 0; time < 3; ++time) ASSERT_TRUE(walk.Reconsider().ok());
  EXPECT_EQ(walk.Error_m(), error_m);
  EXPECT_EQ(walk.state.Registered().size(), kNumPlaced);
  EXPECT_EQ(walk.log[kBeyondNeighbour].num_reconsidered, 2);
}

TEST(ReconsiderImages, IsCancelledOnRequest) {
  WronglyPlaced walk;
  std::stop_source source;
  source.request_stop();
  const StageContext context = {.stop = source.get_token()};
  EXPECT_EQ(ReconsiderImages(walk.state, {}, {}, walk.log, context).code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
