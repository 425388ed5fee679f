// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_part.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(AdjustPart, MovesADisplacedImageBackAndHoldsTheOthers) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0), .noise_px = 0.0});
  MappingState state = street.TriangulatedStateWith(FirstImages(5));
  const Rigid3 truth = state.CamFromWorld(2);
  state.SetPose(2,
                {truth.rotation * RotationFromVector({0.01, -0.01, 0.02}),
                 truth.translation + Eigen::Vector3d(0.05, 0.02, -0.04)});
  const std::vector<ImageSlot> images = {2};
  ASSERT_TRUE(AdjustPart(state, images, AllPoints(state), {}, {}).ok());
  EXPECT_LT((state.Centre(2) - truth.Centre()).norm(), 1e-5);
  EXPECT_EQ(state.CamFromWorld(1).translation, street.world.cams_from_world[1].translation);
}

TEST(AdjustPart, HoldsImagesToTheirPositionsInEnu) {
  StreetFixture street({.centres = StraightWalk(6, 3.0), .random_rotations = true});
  for (ImageSlot image = 0; image < 6; ++image) {
    PosePrior& prior = street.world.problem.images[image].prior;
    prior.position_in_enu = Eigen::Vector3d(1.0 + 3.6 * image, 1.0, 0.5);
    prior.horizontal_sigma_m = prior.vertical_sigma_m = 1.0;
  }
  for (const bool in_enu : {false, true}) {
    MappingState state = street.TriangulatedStateWith(FirstImages(6));
    if (in_enu) state.SetInEnu(1.0, std::vector<double>(6, 0.0));
    ASSERT_TRUE(AdjustPart(state, FirstImages(6), AllPoints(state), {}, {}).ok());
    const double step = (state.Centre(5) - state.Centre(0)).norm() / 5.0;
    EXPECT_NEAR(step, in_enu ? 3.6 : 3.0, 0.01);
    const double off = (state.Centre(3) - Eigen::Vector3d(11.8, 1.0, 0.5)).norm();
    EXPECT_EQ(off < 0.05, in_enu);
  }
}

TEST(AdjustPart, KnowsWhatTheHeightsOfADriveAreOff) {
  StreetFixture street({.centres = StraightWalk(6, 3.0), .random_rotations = true});
  std::vector<double> offsets_m;
  for (ImageSlot image = 0; image < 6; ++image) {
    offsets_m.push_back(image < 3 ? 0.0 : 40.0);
    PosePrior& prior = street.world.problem.images[image].prior;
    prior.position_in_enu = Eigen::Vector3d(3.0 * image, 1.0, 0.5 + offsets_m.back());
    prior.horizontal_sigma_m = prior.vertical_sigma_m = 1.0;
  }
  MappingState state = street.TriangulatedStateWith(FirstImages(6));
  state.SetInEnu(1.0, offsets_m);
  ASSERT_TRUE(AdjustPart(state, FirstImages(6), AllPoints(state), {}, {}).ok());
  EXPECT_LT((state.Centre(5) - Eigen::Vector3d(15.0, 1.0, 0.5)).norm(), 0.05);
}

TEST(AdjustPart, LeavesTheStateAloneWhenCancelled) {
  const StreetFixture street({.centres = StraightWalk(3, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(3));
  const Eigen::Vector3d before = state.Point(0).position;
  std::stop_source source;
  source.request_stop();
  const auto report =
      AdjustPart(state, FirstImages(3), AllPoints(state), {}, {.stop = source.get_token()});
  EXPECT_EQ(report.status().code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(state.Point(0).position, before);
}

TEST(NodeSigma, IsTheKeypointsThoughNeverZero) {
  RayStreet world = MakeStreet({.centres = StraightWalk(2, 3.0)});
  world.problem.images[0].sigma_rad[0] = 0.01F;
  world.problem.images[0].sigma_rad[1] = 0.0F;
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(world.problem).value();
  const MappingState state(world.problem, graph);
  EXPECT_FLOAT_EQ(static_cast<float>(NodeSigma(state, 0)), 0.01F);
  EXPECT_GT(NodeSigma(state, 1), 0.0);
}

}  // namespace
}  // namespace orbweave
