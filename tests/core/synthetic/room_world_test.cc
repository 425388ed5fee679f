// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/room_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/rigid3.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/realistic_street.h"
#include "core/synthetic/street.h"

namespace orbweave {
namespace {

Street Room() { return MakeStreet(RoomOptions({.panoramas = 36})); }

TEST(RoomWorld, IsClosedAndLeavesRoomForTheCamera) {
  const Street room = Room();
  const Traffic none({});
  for (const Rigid3& cam : room.cams_from_enu) {
    const Eigen::Vector3d centre = cam.Centre() - room.street_in_enu;
    for (int k = 0; k < 500; ++k) {
      const double up = -0.99 + 1.98 * k / 499.0;
      const double across = std::sqrt(1.0 - up * up);
      const LightRay ray{centre, {across * std::cos(2.4 * k), across * std::sin(2.4 * k), up}};
      const SurfaceHit hit = Trace(room.world, none, ray);
      ASSERT_NE(hit.surface, SurfaceHit::kSky);
      ASSERT_NE(hit.surface, SurfaceHit::kGround);
      EXPECT_FALSE(hit.in_sun);
      EXPECT_GT(hit.distance_m, 0.15);
      EXPECT_LT(hit.distance_m, 20.0);
    }
  }
}

TEST(RoomWorld, PanoramasAreLessThanAMetreApartRoundALoop) {
  const Street room = Room();
  for (size_t i = 0; i < 36; ++i) {
    const double step_m =
        (room.cams_from_enu[i].Centre() - room.cams_from_enu[(i + 1) % 36].Centre()).norm();
    EXPECT_GT(step_m, 0.4);
    EXPECT_LT(step_m, 1.0);
  }
}

}  // namespace
}  // namespace orbweave
