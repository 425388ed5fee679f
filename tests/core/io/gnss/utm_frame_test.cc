// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss/utm_frame.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Eigen::Vector3d;

// Ludwigsburg, in zone 32, whose middle is 9 degrees east.
const GeodeticPosition kOrigin{48.9, 9.2, 300.0};

Vector3d Converted(const UtmFrame& frame, const Vector3d& enu) {
  return frame.FromEnu(std::vector<SurfacePoint>{{.position_in_world = enu}})[0].position_in_world;
}

TEST(UtmFrame, PutsTheOriginWhereTablesHaveIt) {
  const UtmFrame frame(kOrigin);
  EXPECT_NE(frame.Wkt().find("UTM zone 32N"), std::string::npos);
  EXPECT_NE(frame.Wkt().find("\"32632\""), std::string::npos);
  const Vector3d origin = Converted(frame, Vector3d::Zero());
  EXPECT_NEAR(origin.x(), 514656.0, 60.0);
  EXPECT_NEAR(origin.y(), 5416300.0, 600.0);
  EXPECT_NEAR(origin.z(), 300.0, 1e-6);
  EXPECT_LT((frame.Origin() - origin).norm(), 1.0);
}

TEST(UtmFrame, TurnsNormalsAsItTurnsPositions) {
  const UtmFrame frame(kOrigin);
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0.6, -0.8, 0)}) {
    const Vector3d moved = Converted(frame, 10.0 * direction) - Converted(frame, Vector3d::Zero());
    const SurfacePoint point{.normal_in_world = direction.cast<float>()};
    const auto turned = frame.FromEnu(std::vector{point})[0].normal_in_world.cast<double>();
    EXPECT_LT((moved.normalized() - turned.eval()).norm(), 1e-4) << direction.transpose();
    EXPECT_NEAR(moved.norm(), 10.0, 0.01);  // the zone's scale is 0.9996
  }
}

TEST(UtmFrame, NamesTheSouthernHemisphereAndStaysInOneZone) {
  const UtmFrame south({-33.9, 18.4, 10.0});
  EXPECT_NE(south.Wkt().find("UTM zone 34S"), std::string::npos);
  EXPECT_NE(south.Wkt().find("10000000"), std::string::npos);
  // 6 degrees end between these two points.
  const UtmFrame border({10.0, 11.9999, 0.0});
  const Vector3d step = Converted(border, {100.0, 0.0, 0.0}) - Converted(border, Vector3d::Zero());
  EXPECT_NEAR(step.norm(), 100.0, 0.2);
  const UtmFrame equator({0.0001, 9.0, 0.0});
  const Vector3d across =
      Converted(equator, {0.0, -100.0, 0.0}) - Converted(equator, Vector3d::Zero());
  EXPECT_NEAR(across.norm(), 100.0, 0.2);
}

}  // namespace
}  // namespace orbweave
