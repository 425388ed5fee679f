// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/sample_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/synthetic/make_street.h"

namespace orbweave {
namespace {

/// Distance of a point from the surface of a turned box, zero on it.
double DistanceFromBox(const Solid& solid, const Eigen::Vector3d& point) {
  const Eigen::Vector3d q = solid.LocalDirection(point - solid.centre).cwiseAbs() - solid.half;
  return std::abs(q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0));
}

TEST(SampleSurface, PointsLieOnTheGroundOrOnASolid) {
  const Street street = MakeStreet({.panoramas = 4});
  const SurfaceSamples samples = SampleSurface(street, 2, 64);
  ASSERT_GT(samples.points_in_enu.size(), 500U);
  ASSERT_EQ(samples.points_in_enu.size(), samples.colors.size());
  for (const Eigen::Vector3d& point_in_enu : samples.points_in_enu) {
    const Eigen::Vector3d point = point_in_enu - street.street_in_enu;
    double nearest_m = std::abs(point.z() - kStreetGround_m);
    for (const Solid& solid : street.world.solids) {
      const double distance_m =
          solid.kind == SolidKind::kCrown
              ? std::abs(
                    solid.LocalDirection(point - solid.centre).cwiseQuotient(solid.half).norm() -
                    1.0)
              : DistanceFromBox(solid, point);
      nearest_m = std::min(nearest_m, distance_m);
    }
    EXPECT_LT(nearest_m, 1e-9);
  }
}

TEST(SampleSurface, PlyHoldsEveryPoint) {
  const SurfaceSamples samples{{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}, {10, 11, 12}}};
  const std::string ply = PlyFromSamples(samples);
  const size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - body, 30U);
  EXPECT_NE(ply.find("element vertex 2\n"), std::string::npos);
  EXPECT_EQ(ply[body + 12], 7);
}

}  // namespace
}  // namespace orbweave
