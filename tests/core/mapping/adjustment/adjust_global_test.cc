// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_global.h"

#include <gtest/gtest.h>

#include "core/mapping/export_submodel.h"
#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

/// Images displaced by some centimetres and hundredths of a radian.
void Disturb(MappingState& state, double amount) {
  Random random(8);
  const auto offset = [&]() -> Eigen::Vector3d {
    return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()) * amount;
  };
  const std::vector<ImageSlot> images = state.Registered();
  for (const ImageSlot image : images) {
    const Rigid3 pose = state.CamFromWorld(image);
    state.SetPose(
        image, {RotationFromVector(0.1 * offset()) * pose.rotation, pose.translation + offset()});
  }
}

TEST(AdjustGrowingModel, BringsADisturbedModelBack) {
  const StreetFixture street({.centres = StraightWalk(10, 3.0), .noise_px = 0.3});
  MappingState state = street.TriangulatedStateWith(FirstImages(10));
  Disturb(state, 0.02);
  ASSERT_GT(ErrorOf(ExportSubmodel(state), street.world.cams_from_world).position_rmse, 0.02);
  ASSERT_TRUE(AdjustGrowingModel(state, {}, {}).ok());
  EXPECT_LT(ErrorOf(ExportSubmodel(state), street.world.cams_from_world).position_rmse, 0.01);
}

TEST(AdjustFinalModel, RemovesWhatStandsOutFromAnExactModel) {
  const StreetFixture street({.centres = StraightWalk(10, 3.0), .noise_px = 0.1});
  MappingState state = street.TriangulatedStateWith(FirstImages(10));
  // Three pixels: within the limit, thirty times the noise.
  CorrespondenceGraph bent = street.graph;
  const double three_pixels = kStreetCamera.AngleFromPixels(3.0);
  uint32_t wrong = 0;
  for (Node node = 0; node < bent.NumNodes(); node += 25) {
    Eigen::Vector3d& bearing = bent.bearing_of_node[node];
    bearing = (bearing + three_pixels * TangentBasis(bearing).col(0)).normalized();
    ++wrong;
  }
  MappingState of_bent(street.world.problem, bent);
  for (const ImageSlot image : FirstImages(10)) {
    of_bent.Register(image, street.world.cams_from_world[image]);
    TriangulateImage(of_bent, image, {});
  }
  ASSERT_TRUE(AdjustFinalModel(of_bent, {}, {}).ok());
  uint32_t kept = 0;
  for (Node node = 0; node < bent.NumNodes(); node += 25) {
    kept += of_bent.PointOf(node) != kNoPoint ? 1 : 0;
  }
  ASSERT_GT(wrong, 50U);
  EXPECT_LT(kept, wrong / 10);
  EXPECT_GT(of_bent.NumPoints(), 0.9 * state.NumPoints());
}

TEST(AdjustFinalModel, IsCancelledOnRequest) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(4));
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(AdjustFinalModel(state, {}, {.stop = source.get_token()}).code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
