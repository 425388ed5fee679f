// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/start_globally.h"

#include <gtest/gtest.h>

#include "core/mapping/export_submodel.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

bool Start(MappingState& state) {
  const std::vector<uint8_t> available(state.Graph().NumImages(), 1);
  const auto started = StartGlobally(state, available, {}, {});
  EXPECT_TRUE(started.ok()) << started.status();
  return started.ok() && *started;
}

TEST(StartGlobally, HasAllImagesNearTheirPlaces) {
  const StreetFixture street(
      {.centres = StraightWalk(25, 3.0), .outlier_share = 0.1, .random_rotations = true});
  MappingState state = street.StateWith({});
  ASSERT_TRUE(Start(state));
  EXPECT_EQ(state.Registered().size(), 25U);
  const ModelError error = ErrorOf(ExportSubmodel(state), street.world.cams_from_world);
  EXPECT_LT(error.position_rmse, 0.03);
  EXPECT_LT(error.max_rotation_rad, 2e-3);
}

TEST(StartGlobally, LeavesAnImageToRegistrationThatSeesSomethingElse) {
  StreetFixture street({.centres = StraightWalk(15, 3.0)});
  Random random(3);
  for (Node node = street.graph.first_node[7]; node < street.graph.first_node[8]; ++node) {
    street.graph.bearing_of_node[node] =
        Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  }
  MappingState state = street.StateWith({});
  ASSERT_TRUE(Start(state));
  EXPECT_EQ(state.Registered().size(), 14U);
  EXPECT_FALSE(state.IsRegistered(7));
}

TEST(StartGlobally, DoesNotStartWithoutDepth) {
  const StreetFixture street({.centres = StraightWalk(6, 0.0), .points_per_metre = 80});
  MappingState state = street.StateWith({});
  EXPECT_FALSE(Start(state));
}

TEST(StartGlobally, DoesNotStartWithoutPairs) {
  const StreetFixture street({.centres = StraightWalk(4, 100.0)});
  ASSERT_TRUE(street.graph.pairs.empty());
  MappingState state = street.StateWith({});
  EXPECT_FALSE(Start(state));
}

}  // namespace
}  // namespace orbweave
