// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/export_submodel.h"

#include <gtest/gtest.h>

#include "core/mapping/adjustment/adjust_part.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(ExportSubmodel, HoldsEveryPoseAndObservation) {
  StreetFixture street({.centres = StraightWalk(5, 3.0)});
  for (ClusterImage& image : street.world.problem.images) image.id.value += 40;
  const MappingState state = street.TriangulatedStateWith({0, 1, 2, 3});
  const Reconstruction model = ExportSubmodel(state);
  ASSERT_EQ(model.images.size(), 4U);
  EXPECT_EQ(model.images.begin()->first, ImageId(40));
  EXPECT_EQ(model.images.at(ImageId(42)).cam_from_world.translation,
            street.world.cams_from_world[2].translation);
  EXPECT_EQ(model.tracks.size(), state.NumPoints());
  EXPECT_EQ(model.NumObservations(), state.NumObservations());
  for (const Track& track : model.tracks) {
    EXPECT_TRUE(std::ranges::is_sorted(track.observations, {}, &Observation::ref));
    for (const Observation& seen : track.observations) {
      const ClusterImage& image = street.world.problem.images[seen.ref.image.value - 40];
      EXPECT_EQ(seen.bearing, image.bearings[seen.ref.feature]);
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(model.tracks, {}, &Track::Name));
}

TEST(ExportSubmodel, MixesTheColoursOfATrack) {
  StreetFixture street({.centres = StraightWalk(2, 3.0)});
  for (Rgb& color : street.world.problem.images[0].colors) color = {10, 0, 255};
  for (Rgb& color : street.world.problem.images[1].colors) color = {21, 0, 255};
  const Reconstruction model = ExportSubmodel(street.TriangulatedStateWith({0, 1}));
  ASSERT_FALSE(model.tracks.empty());
  EXPECT_EQ(model.tracks.front().color, (Rgb{16, 0, 255}));
}

}  // namespace
}  // namespace orbweave
