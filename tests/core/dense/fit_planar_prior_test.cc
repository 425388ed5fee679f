// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/fit_planar_prior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"
#include "core/dense/rough_places.h"
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
        field.sigma[at] = 0.002F;
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

/// Nothing that is seen speaks for any plane.
PlaneEvidence NoEvidence(size_t num_planes) {
  const size_t cells = kFace_px / 2;
  PlaneEvidence evidence{.cells = kFace_px / 2};
  evidence.texture.resize(kCubeFaces * cells * cells);
  evidence.correlation.assign(num_planes + 1, std::vector<float>(evidence.texture.size()));
  return evidence;
}

PlanarPrior PriorOf(const PlaneField& field) {
  const std::vector<ReliablePoint> points = ReliablePoints(RasterOfBox(), field);
  const std::vector<FittedPlane> planes = FindPlanes(kFace_px, points, 1);
  return LayOnPlanes(kFace_px, points, planes, NoEvidence(planes.size()));
}

size_t CellOf(int face, int row, int column) {
  return static_cast<size_t>((face * kFace_px / 2 + row / 2) * (kFace_px / 2) + column / 2);
}

/// The box with a blank front, where a plane `front_m` away may be.
struct BlankFront {
  explicit BlankFront(double front_m) {
    planes.push_back({Eigen::Vector3f::UnitZ(), static_cast<float>(front_m), {.relief_m = 0.01F}});
    evidence = NoEvidence(planes.size());
  }

  [[nodiscard]] uint8_t LabelAt(int row, int column) const {
    const PlanarPrior prior = LayOnPlanes(kFace_px, points, planes, evidence);
    return prior.labels[EquiangularRaster{kFace_px}.Index(0, row, column)];
  }

  std::vector<ReliablePoint> points =
      ReliablePoints(RasterOfBox(), FieldOfBox([](int face, int, int) { return face == 0; }));
  std::vector<FittedPlane> planes = FindPlanes(kFace_px, points, 1);
  uint8_t front = static_cast<uint8_t>(planes.size());
  PlaneEvidence evidence{};
};

TEST(FindPlanes, JoinsTheLayersThatErrorsCutAPlaneInto) {
  std::vector<ReliablePoint> points;
  Random random(5);
  for (int k = 0; k < 4000; ++k) {
    const Eigen::Vector3f on(static_cast<float>(random.Uniform(-8, 8)),
                             static_cast<float>(random.Uniform(-6, 3)),
                             12.0F + 0.08F * static_cast<float>(random.Normal()));
    points.push_back({on, Eigen::Vector3f::UnitZ(), static_cast<uint32_t>(k), 0.08F});
  }
  const std::vector<FittedPlane> planes = FindPlanes(kFace_px, points, 1);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_NEAR(planes[0].distance_m, 12.0F, 0.01F);
  // As many independent errors as there are patches; none tells its relief, but the tolerance does.
  EXPECT_NEAR(planes[0].errors.SigmaAt({0.0F, -1.5F, 12.0F}), 0.084F / std::sqrt(3.0F), 0.01F);
}

TEST(FindPlanes, KeepsKerbAndRoadApart) {
  std::vector<ReliablePoint> points;
  Random random(6);
  for (int k = 0; k < 4000; ++k) {
    const auto across_m = static_cast<float>(random.Uniform(-5, 5));
    const float height_m = across_m > 2.0F ? 2.38F : 2.5F;
    points.push_back({{across_m, height_m, static_cast<float>(random.Uniform(-6, 6))},
                      Eigen::Vector3f::UnitY(),
                      static_cast<uint32_t>(k)});
  }
  const std::vector<FittedPlane> planes = FindPlanes(kFace_px, points, 1);
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_NEAR(planes[0].distance_m, 2.5F, 1e-3F);
  EXPECT_NEAR(planes[1].distance_m, 2.38F, 1e-3F);
}

TEST(FindPlanes, TakesNoPlaneOutOfASlope) {
  std::vector<ReliablePoint> points;
  Random random(7);
  const Eigen::Vector3f normal = Eigen::Vector3f(0.0F, -0.5F, 0.8F).normalized();
  for (int k = 0; k < 4000; ++k) {
    const auto x = static_cast<float>(random.Uniform(-4, 4));
    const auto y = static_cast<float>(random.Uniform(-4, 4));
    points.push_back(
        {{x, y, (8.0F - normal.y() * y) / normal.z()}, normal, static_cast<uint32_t>(k)});
  }
  EXPECT_TRUE(FindPlanes(kFace_px, points, 1).empty());
}

TEST(FindRoughPlaces, TellsAWallFromASlabOfACrown) {
  constexpr int kCells = kFace_px / 2;
  const EquiangularRaster raster{kFace_px};
  const FittedPlane wall{Eigen::Vector3f::UnitZ(), 8.0F, 0.01F};
  Random random(8);
  std::vector<ReliablePoint> points;
  for (int row = 0; row < kFace_px; ++row) {
    for (int column = 0; column < kFace_px; ++column) {
      const Eigen::Vector3f ray = raster.BearingFromPixel(0, row + 0.5, column + 0.5).cast<float>();
      const bool crown = column >= kFace_px / 2;
      const auto z_m = static_cast<float>(8.0 + (crown ? random.Uniform(-0.3, 0.3) : 0.0));
      points.push_back({ray * (z_m / ray.z()),
                        Eigen::Vector3f::UnitZ(),
                        static_cast<uint32_t>(raster.Index(0, row, column))});
    }
  }
  const auto rough = FindRoughPlaces(kFace_px, points, {wall});
  ASSERT_EQ(rough.size(), 1U);
  EXPECT_EQ(rough[0][CellOf(0, kFace_px / 2, 12)], 0);
  EXPECT_EQ(rough[0][CellOf(0, kFace_px / 2, kFace_px - 12)], 1);
  EXPECT_EQ(rough[0].size(), static_cast<size_t>(kCubeFaces * kCells * kCells));
}

TEST(LayOnPlanes, GivesPixelsThePlaneThatTheirSurroundingsSpeakFor) {
  BlankFront box(testing::kBoxHalf_m.z());
  box.evidence.correlation[box.front][CellOf(0, 10, 32)] = 0.3F;
  box.evidence.correlation[box.front][CellOf(0, 12, 40)] = 0.3F;
  box.evidence.correlation[0][CellOf(0, 12, 40)] = 0.29F;  // nearly as much
  EXPECT_EQ(box.LabelAt(10, 32), box.front);
  EXPECT_NE(box.LabelAt(12, 40), box.front);
}

TEST(LayOnPlanes, LeavesTheSkyToItself) {
  BlankFront box(4.0);
  std::ranges::fill(box.evidence.correlation[box.front], 0.5F);
  const auto label_of = [&](int row, float sky) {
    std::ranges::fill(box.evidence.correlation.back(), sky);
    return box.LabelAt(row, 32);
  };
  EXPECT_EQ(label_of(20, 0.3F), box.front);
  EXPECT_EQ(label_of(20, 0.6F), PlanarPrior::kNone);
  EXPECT_EQ(label_of(36, 0.6F), box.front);  // below the horizon there is none
}

TEST(LayOnPlanes, SeesNothingThroughTheGround) {
  BlankFront box(60.0);
  std::ranges::fill(box.evidence.correlation[box.front], 0.5F);
  EXPECT_EQ(box.LabelAt(20, 32), box.front);
  EXPECT_NE(box.LabelAt(60, 32), box.front);
}

TEST(LayOnPlanes, FindsTheFloorAndTheFourWallsOfABox) {
  const PlanarPrior prior = PriorOf(FieldOfBox([](int, int, int) { return false; }));
  ASSERT_EQ(prior.planes.size(), 5U);  // streets have no ceiling
  for (const Eigen::Vector3f& plane : prior.planes) {
    const Eigen::Vector3f normal = plane.normalized();
    Eigen::Index axis = 0;
    EXPECT_NEAR(normal.cwiseAbs().maxCoeff(&axis), 1.0F, 1e-4F);
    EXPECT_NEAR(1.0F / plane.norm(), testing::kBoxHalf_m[axis], 1e-3F);
  }
  for (const PlaneErrors& errors : prior.errors)
    EXPECT_FLOAT_EQ(errors.relief_m, 0.0005F);  // the least
}

TEST(LayOnPlanes, LaysBlankPatchesOnTheWallAroundThem) {
  const auto is_blank = [](int face, int row, int column) {
    return face == 5 && row > 20 && row < 44 && column > 20 && column < 44;
  };
  const PlanarPrior prior = PriorOf(FieldOfBox(is_blank));
  const uint8_t label = prior.labels[EquiangularRaster{kFace_px}.Index(5, 32, 32)];
  ASSERT_NE(label, PlanarPrior::kNone);
  EXPECT_NEAR(prior.planes[label].y(), 1.0 / testing::kBoxHalf_m.y(), 1e-3);
}

TEST(LayOnPlanes, LeavesASkyBetweenWallsOpen) {
  const auto is_blank = [](int face, int row, int column) {
    return face == 4 || (face == 0 && row < 25 && column > 20 && column < 44);
  };
  const PlanarPrior prior = PriorOf(FieldOfBox(is_blank));
  EXPECT_EQ(prior.labels[EquiangularRaster{kFace_px}.Index(0, 10, 32)], PlanarPrior::kNone);
  EXPECT_EQ(prior.labels[EquiangularRaster{kFace_px}.Index(4, 32, 32)], PlanarPrior::kNone);
}

TEST(LayOnPlanes, HasNoPlanesWhereNothingMatches) {
  const PlanarPrior prior = PriorOf(FieldOfBox([](int, int, int) { return true; }));
  EXPECT_TRUE(prior.planes.empty());
  for (const uint8_t label : prior.labels) EXPECT_EQ(label, PlanarPrior::kNone);
}

}  // namespace
}  // namespace orbweave
