// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_new_images.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/geometry/rotation.h"
#include "core/mapping/adjustment/weigh_pixels_alike.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

const MappingOptions kPaper = {.preset = MappingPreset::kPaper};

Rigid3 Shifted(const Rigid3& pose, const Eigen::Vector3d& shift) {
  return Rigid3::FromCentre(pose.rotation, pose.Centre() + shift);
}

TEST(AdjustPose, PutsAnImageWhereItsPointsSayAndMovesNothingElse) {
  const StreetFixture street({.centres = StraightWalk(10, 3.0), .points_per_metre = 20});
  MappingState state = street.TriangulatedStateWith({0, 1, 2, 3, 4});
  const Rigid3& truth = street.world.cams_from_world[5];
  state.Register(5, Shifted(truth, {0.008, -0.006, 0.005}));
  const double before_m = (state.Centre(5) - truth.Centre()).norm();
  const std::vector<PointIndex> points = [&] {
    std::vector<PointIndex> all;
    for (PointIndex p = 0; p < state.EndOfPoints(); ++p)
      if (!state.Point(p).nodes.empty()) all.push_back(p);
    return all;
  }();
  std::vector<Eigen::Vector3d> positions;
  for (const PointIndex point : points) positions.push_back(state.Point(point).position);
  ASSERT_TRUE(AdjustPose(state, 5, kPaper, {}).ok());
  EXPECT_LT((state.Centre(5) - truth.Centre()).norm(), 0.5 * before_m);
  for (size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(state.Point(points[i]).position, positions[i]);
  EXPECT_EQ(state.NumObservations(5), 0U);
}

TEST(AdjustPose, LeavesAnImageThatSeesNothing) {
  const StreetFixture street({.centres = StraightWalk(30, 3.0)});
  MappingState state = street.TriangulatedStateWith({0, 1});
  state.Register(29, street.world.cams_from_world[29]);
  ASSERT_TRUE(AdjustPose(state, 29, kPaper, {}).ok());
  EXPECT_EQ(state.CamFromWorld(29).translation, street.world.cams_from_world[29].translation);
}

TEST(AdjustNewImages, MovesTheNewImagesAlone) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(12));
  const std::vector<ImageSlot> images = {3, 7, 8, 9};
  ASSERT_TRUE(AdjustNewImages(state, images, kPaper, {}).ok());
  for (ImageSlot image = 0; image < 12; ++image) {
    const bool moved = state.Centre(image) != street.world.cams_from_world[image].Centre();
    EXPECT_EQ(moved, std::ranges::count(images, image) > 0) << image;
  }
}

TEST(WeighPixelsAlike, GivesEveryObservationAPixel) {
  RayStreet street = MakeStreet({.centres = StraightWalk(4, 3.0)});
  street.problem.images[1].sigma_rad.front() *= 3.0F;
  const auto alike = WeighPixelsAlike(street.problem);
  ASSERT_TRUE(alike.has_value());
  for (const ClusterImage& image : alike->images) {
    for (const float sigma_rad : image.sigma_rad)
      EXPECT_FLOAT_EQ(sigma_rad, static_cast<float>(image.camera.AngleFromPixels(1.0)));
  }
  EXPECT_FALSE(WeighPixelsAlike(*alike).has_value());
}

}  // namespace
}  // namespace orbweave
