// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_globally.h"

#include <gtest/gtest.h>

#include "core/mapping/export_submodel.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

GlobalModel Reconstruct(const StreetFixture& street) {
  const std::vector<uint8_t> available(street.graph.NumImages(), 1);
  RegistrationLog log(street.graph.NumImages());
  auto model = ReconstructGlobally(
      street.world.problem, street.graph, available, GlobalStart::kPairs, {}, log, {});
  EXPECT_TRUE(model.ok()) << model.status();
  return model.ok() ? *std::move(model) : GlobalModel{};
}

TEST(ReconstructGlobally, ReachesTheNoiseLevel) {
  const StreetFixture street({.centres = StraightWalk(30, 3.0), .outlier_share = 0.02});
  const GlobalModel model = Reconstruct(street);
  ASSERT_TRUE(model.state.has_value());
  EXPECT_EQ(model.fault, "");
  EXPECT_EQ(model.state->Registered().size(), 30U);
  EXPECT_EQ(model.growth.num_local_adjustments, 0);
  const ModelError error = ErrorOf(ExportSubmodel(*model.state), street.world.cams_from_world);
  EXPECT_LT(error.position_rmse, 0.01);
  EXPECT_LT(error.max_rotation_rad, 1e-3);
}

TEST(ReconstructGlobally, SaysWhyItHasNoModel) {
  const StreetFixture street({.centres = StraightWalk(6, 0.0), .points_per_metre = 80});
  const GlobalModel model = Reconstruct(street);
  EXPECT_FALSE(model.state.has_value());
  EXPECT_EQ(model.fault, "pairs place 0 images only");
}

}  // namespace
}  // namespace orbweave
