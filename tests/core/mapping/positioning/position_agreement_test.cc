// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/position_agreement.h"

#include <gtest/gtest.h>

#include "core/geometry/sim3.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Two legs of a street at a right angle, ten images each, 8 m apart; the second leg of the model
/// is `stretch` times as long as it should be. GNSS of 2 m in a frame of its own.
std::optional<double> AgreementOf(double stretch, uint32_t with_position = 20) {
  std::vector<Vector3d> centres;
  for (int i = 0; i < 10; ++i) centres.emplace_back(8.0 * i, 0.0, 0.0);
  for (int i = 1; i <= 10; ++i) centres.emplace_back(72.0, 0.0, 8.0 * i);
  StreetFixture street({.centres = centres, .points_per_metre = 1, .random_rotations = true});
  const Sim3 enu_from_world{1.7, RotationFromVector({0.3, -2.0, 0.4}), {10.0, -4.0, 7.0}};
  const Eigen::Quaterniond level =
      RotationBetween(enu_from_world.rotation * -Vector3d::UnitY(), Vector3d::UnitZ());
  Random random(2);
  for (uint32_t i = 0; i < with_position; ++i) {
    PosePrior& prior = street.world.problem.images[i].prior;
    const Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    prior.position_in_enu = level * (enu_from_world * centres[i]) + noise;
    prior.horizontal_sigma_m = 2.0;
  }
  MappingState state = street.StateWith(FirstImages(20));
  for (ImageSlot image = 10; image < 20; ++image) {
    const Vector3d stretched(72.0, 0.0, stretch * centres[image].z());
    state.SetPose(image, Rigid3::FromCentre(state.CamFromWorld(image).rotation, stretched));
  }
  return AgreementWithPositions(state);
}

TEST(AgreementWithPositions, IsFullForARightModelInAnyFrame) { EXPECT_EQ(AgreementOf(1.0), 1.0); }

TEST(AgreementWithPositions, FallsWhereOneStreetHasAnotherScale) {
  EXPECT_LT(AgreementOf(1.8), 0.8);
}

TEST(AgreementWithPositions, SaysNothingFromFewPositions) {
  EXPECT_FALSE(AgreementOf(1.8, 9).has_value());
}

}  // namespace
}  // namespace orbweave
