// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/planar_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dense/equiangular_raster.h"
#include "tests/core/dense/box_world.h"

namespace orbweave {
namespace {

constexpr int kFace_px = 64;
constexpr int kApron = PlaneField::kApron_px;

/// The true planes of the box; nothing matches where `is_blank`.
template <typename IsBlank>
PlaneField FieldOfBox(IsBlank&& is_blank) {
  const EquiangularRaster raster{kFace_px};
  PlaneField field(kFace_px);
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < kFace_px; ++row) {
      for (int column = 0; column < kFace_px; ++column) {
        const size_t at = field.AtPixel(face, row + kApron, column + kApron);
        const Eigen::Vector3d bearing = raster.BearingFromPixel(face, row + 0.5, column + 0.5);
        const Eigen::Vector3d point =
            testing::RangeInBox(Eigen::Vector3d::Zero(), bearing) * bearing;
        const Eigen::Vector3d normal = testing::NormalInBox(point);
        const Eigen::Vector3f q = (FaceFromCamera(face) * normal / normal.dot(point)).cast<float>();
        field.x[at] = q.x();
        field.y[at] = q.y();
        field.z[at] = q.z();
        if (is_blank(face, row, column)) continue;
        field.cost[at] = 0.1F;
        field.sigma[at] = 0.005F;
      }
    }
  }
  return field;
}

ReferenceRaster RasterOfBox() {
  return MakeReferenceRaster(MakeGreyPanorama(
      testing::RenderBox(4 * kFace_px,
                         Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {0, 0, 0}))
          .Raster()));
}

TEST(FitPlanarPrior, FindsTheSixWallsOfABox) {
  const PlanarPrior prior =
      FitPlanarPrior(RasterOfBox(), FieldOfBox([](int, int, int) { return false; }), 1);
  ASSERT_EQ(prior.planes.size(), 6U);
  for (const Eigen::Vector3f& plane : prior.planes) {
    const Eigen::Vector3f normal = plane.normalized();
    Eigen::Index axis = 0;
    EXPECT_NEAR(normal.cwiseAbs().maxCoeff(&axis), 1.0F, 1e-4F);
    EXPECT_NEAR(1.0F / plane.norm(), testing::kBoxHalf_m[axis], 1e-3F);
  }
  for (const float scatter_m : prior.scatter_m) EXPECT_LT(scatter_m, 1e-3F);
}

TEST(FitPlanarPrior, LaysBlankPatchesOnTheWallAroundThem) {
  const auto is_blank = [](int face, int row, int column) {
    return face == 5 && row > 20 && row < 44 && column > 20 && column < 44;
  };
  const PlanarPrior prior = FitPlanarPrior(RasterOfBox(), FieldOfBox(is_blank), 1);
  const uint8_t label = prior.labels[EquiangularRaster{kFace_px}.Index(5, 32, 32)];
  ASSERT_NE(label, PlanarPrior::kNone);
  EXPECT_NEAR(prior.planes[label].y(), 1.0 / testing::kBoxHalf_m.y(), 1e-3);
}

TEST(FitPlanarPrior, LeavesASkyBetweenWallsOpen) {
  const auto is_blank = [](int face, int row, int column) {
    return face == 4 || (face == 0 && row < 25 && column > 20 && column < 44);
  };
  const PlanarPrior prior = FitPlanarPrior(RasterOfBox(), FieldOfBox(is_blank), 1);
  EXPECT_EQ(prior.labels[EquiangularRaster{kFace_px}.Index(0, 10, 32)], PlanarPrior::kNone);
  EXPECT_EQ(prior.labels[EquiangularRaster{kFace_px}.Index(4, 32, 32)], PlanarPrior::kNone);
}

TEST(FitPlanarPrior, HasNoPlanesWhereNothingMatches) {
  const PlanarPrior prior =
      FitPlanarPrior(RasterOfBox(), FieldOfBox([](int, int, int) { return true; }), 1);
  EXPECT_TRUE(prior.planes.empty());
  for (const uint8_t label : prior.labels) EXPECT_EQ(label, PlanarPrior::kNone);
}

}  // namespace
}  // namespace orbweave
