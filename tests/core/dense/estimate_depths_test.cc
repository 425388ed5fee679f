// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/estimate_depths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"
#include "core/geometry/rotation.h"
#include "tests/core/dense/box_world.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using testing::BoxImage;
using testing::BoxScene;

constexpr int kWidth_px = 512;

/// Pixels of a map of the box against the truth.
struct Errors {
  std::vector<double> relative{};  // of ranges
  std::vector<double> normals_deg{};
  std::vector<double> sigmas{};  // errors in sigmas
  size_t asked = 0;

  [[nodiscard]] double Share() const {
    return static_cast<double>(relative.size()) / static_cast<double>(asked);
  }
};

double QuantileOf(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Of the pixels for which `asks(face, row, column)`, and that are not near an edge of the box.
template <typename Asks>
Errors Compare(const DepthMap& map, const BoxImage& image, Asks&& asks) {
  const EquiangularRaster raster{map.face_px};
  Errors errors;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < map.face_px; ++row) {
      for (int column = 0; column < map.face_px; ++column) {
        const Eigen::Vector3d bearing = raster.BearingFromPixel(face, row + 0.5, column + 0.5);
        const double range_m = image.RangeAlong(bearing);
        const Eigen::Quaterniond box_from_cam = image.cam_from_box.rotation.conjugate();
        const Eigen::Vector3d point = box_from_cam * bearing * range_m;
        Eigen::Vector3d to_edges =
            (testing::kBoxHalf_m - point.cwiseAbs()).cwiseQuotient(testing::kBoxHalf_m);
        std::sort(to_edges.begin(), to_edges.end());
        if (to_edges[1] < 0.15 || !asks(face, row, column)) continue;
        ++errors.asked;
        const size_t k = raster.Index(face, row, column);
        if (!(map.range_m[k] > 0.0F)) continue;
        errors.relative.push_back(std::abs(map.range_m[k] / range_m - 1.0));
        errors.sigmas.push_back(std::abs(map.range_m[k] - range_m) /
                                static_cast<double>(map.sigma_m[k]));
        const Eigen::Vector3d normal = box_from_cam * DecodeNormal(map.normals[k]).cast<double>();
        errors.normals_deg.push_back(AngleBetween(normal, testing::NormalInBox(point)) * 180.0 /
                                     std::numbers::pi);
      }
    }
  }
  return errors;
}

bool Everywhere(int, int, int) { return true; }

/// Within ten pixels of a face's edge.
bool NearFaceEdges(int, int row, int column) {
  const int size = kWidth_px / 4;
  return std::min({row, column, size - 1 - row, size - 1 - column}) < 10;
}

const BoxScene& Scene() {
  static const BoxScene kScene(kWidth_px);
  return kScene;
}

const DepthMap& MapOfScene() {
  static const DepthMap kMap = EstimateDepths(Scene().Problem(), {});
  return kMap;
}

/// Turned so that no wall is level or upright, as planes of streets are.
const BoxScene& TurnedScene() {
  static const BoxScene kScene = [] {
    Random random(5);
    return BoxScene(kWidth_px, testing::RandomRotation(random));
  }();
  return kScene;
}

const DepthMap& MapOfTurnedScene() {
  static const DepthMap kMap = EstimateDepths(TurnedScene().Problem(), {});
  return kMap;
}

TEST(EstimateDepths, FindsWallsToAFractionOfAPixel) {
  const Errors errors = Compare(MapOfScene(), Scene().reference, Everywhere);
  EXPECT_GT(errors.Share(), 0.97);
  // A pixel of parallax is 1.2 degrees; with 0.5 m between panoramas, a tenth of it 1.3 % at 3 m.
  EXPECT_LT(QuantileOf(errors.relative, 0.5), 0.002);
  EXPECT_LT(QuantileOf(errors.relative, 0.95), 0.03);
  EXPECT_LT(QuantileOf(errors.normals_deg, 0.5), 0.3);
}

TEST(EstimateDepths, IsWithinATwentiethOfAPixelAtEdgesOfFaces) {
  const Errors all = Compare(MapOfTurnedScene(), TurnedScene().reference, Everywhere);
  const Errors edges = Compare(MapOfTurnedScene(), TurnedScene().reference, NearFaceEdges);
  EXPECT_GT(edges.Share(), all.Share() - 0.03);
  EXPECT_LT(QuantileOf(edges.relative, 0.5), 0.006);
  EXPECT_LT(QuantileOf(edges.relative, 0.95), 2.0 * QuantileOf(all.relative, 0.95));
}

TEST(EstimateDepths, KnowsItsSigma) {
  const Errors errors = Compare(MapOfScene(), Scene().reference, Everywhere);
  EXPECT_LT(QuantileOf(errors.sigmas, 0.68), 1.3);
  EXPECT_GT(QuantileOf(errors.sigmas, 0.68), 0.25);
  EXPECT_LT(QuantileOf(errors.sigmas, 0.9), 2.5);
}

TEST(EstimateDepths, FindsTheSameWhicheverWayThePanoramaIsTurned) {
  const Errors errors = Compare(MapOfTurnedScene(), TurnedScene().reference, Everywhere);
  const Errors before = Compare(MapOfScene(), Scene().reference, Everywhere);
  EXPECT_GT(errors.Share(), before.Share() - 0.03);
  EXPECT_LT(QuantileOf(errors.relative, 0.5), 2.0 * QuantileOf(before.relative, 0.5));
  // Planes as streets have them are tried, too: a tenth of a pixel is what others keep.
  EXPECT_LT(QuantileOf(errors.relative, 0.95), 0.013);
}

TEST(EstimateDepths, GivesTheSameBytesOnEveryInstructionSetAndEveryTime) {
  const BoxScene small(128);
  const DepthMap expected = EstimateDepths(small.Problem(), {}, MatchKernel::kPortable);
  ASSERT_EQ(expected.problem, "");
  for (const MatchKernel kernel : AvailableMatchKernels()) {
    const DepthMap map = EstimateDepths(small.Problem(), {}, kernel);
    EXPECT_EQ(map.range_m, expected.range_m);
    EXPECT_EQ(map.sigma_m, expected.sigma_m);
    EXPECT_EQ(map.normals, expected.normals);
  }
}

TEST(EstimateDepths, HasNothingWithinMasks) {
  BoxScene scene(256);
  scene.reference.ignored.assign(256 * 128, 0);
  for (size_t k = 80 * 256; k < 128 * 256; ++k) scene.reference.ignored[k] = 255;
  scene.sources[0].ignored.assign(256 * 128, 255);
  const DepthMap map = EstimateDepths(scene.Problem(), {});
  ASSERT_EQ(map.face_px, 64);
  const EquiangularRaster raster{64};
  size_t found = 0;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 64; ++column) {
        const Eigen::Vector3d bearing = raster.BearingFromPixel(face, row + 0.5, column + 0.5);
        const double image_row = EquirectangularCamera{256, 128}.PixelFromBearing(bearing).y();
        const bool has_range = map.range_m[raster.Index(face, row, column)] > 0.0F;
        found += has_range ? 1 : 0;
        EXPECT_FALSE(has_range && image_row > 81.0) << face << " " << row << " " << column;
      }
    }
  }
  EXPECT_GT(found, 5000U);
}

TEST(EstimateDepths, FindsWallsFromSeedsAsWell) {
  BoxScene scene(256);
  DepthProblem problem = scene.Problem();
  Random random(9);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d bearing = testing::RandomDirection(random);
    problem.seeds.push_back({bearing, scene.reference.RangeAlong(bearing), 0.01});
  }
  problem.seeds.push_back({Eigen::Vector3d::UnitX(), std::nan(""), 0.01});
  const Errors errors = Compare(EstimateDepths(problem, {}), scene.reference, Everywhere);
  EXPECT_GT(errors.Share(), 0.9);
  EXPECT_LT(QuantileOf(errors.relative, 0.5), 0.01);
}

TEST(EstimateDepths, OneSourceIsEnough) {
  const BoxScene scene(256);
  DepthProblem problem = scene.Problem();
  problem.sources.resize(1);
  const Errors errors = Compare(EstimateDepths(problem, {}), scene.reference, Everywhere);
  EXPECT_GT(errors.Share(), 0.7);  // along the line of both nothing moves
  // A pixel of parallax is 1.4 degrees; with 0.5 m between both, a tenth of it 1.5 % at 3 m.
  EXPECT_LT(QuantileOf(errors.relative, 0.5), 0.015);
}

TEST(EstimateDepths, LeavesOutASourceThatCannotBe) {
  const BoxScene scene(128);
  DepthProblem good = scene.Problem();
  DepthProblem mixed = scene.Problem();
  good.sources.resize(2);
  mixed.sources.resize(3);
  mixed.sources[2].source_from_reference.rotation.coeffs().setConstant(
      std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(EstimateDepths(mixed, {}).range_m, EstimateDepths(good, {}).range_m);
  mixed = scene.Problem();
  mixed.sources.resize(3);
  mixed.sources[2].image.width_px /= 2;  // an image of another size than its camera's
  EXPECT_EQ(EstimateDepths(mixed, {}).range_m, EstimateDepths(good, {}).range_m);
}

TEST(EstimateDepths, SaysWhyThereIsNothing) {
  const BoxScene scene(128);
  const auto problem_of = [](const DepthProblem& problem) {
    const DepthMap map = EstimateDepths(problem, {});
    EXPECT_EQ(map.face_px, 0);
    EXPECT_EQ(map.size(), 0U);
    return map.problem;
  };
  DepthProblem none = scene.Problem();
  none.sources.clear();
  EXPECT_NE(problem_of(none), "");

  DepthProblem standing = scene.Problem();
  for (DepthSource& source : standing.sources) source.source_from_reference.translation.setZero();
  EXPECT_NE(problem_of(standing), "");

  DepthProblem nowhere = scene.Problem();
  for (DepthSource& source : nowhere.sources)
    source.source_from_reference.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(problem_of(nowhere), "");

  BoxScene masked(128);
  masked.reference.ignored.assign(128 * 64, 1);
  EXPECT_NE(problem_of(masked.Problem()), "");

  DepthProblem broken = scene.Problem();
  broken.reference.height_px = 63;
  EXPECT_NE(problem_of(broken), "");

  DepthProblem unlimited = scene.Problem();
  unlimited.max_range_m = 0.0;
  EXPECT_NE(problem_of(unlimited), "");
}

TEST(EstimateDepths, SaysThatConstantImagesShowNothing) {
  BoxScene scene(128);
  std::fill(scene.reference.levels.begin(), scene.reference.levels.end(), uint8_t{90});
  for (BoxImage& source : scene.sources)
    std::fill(source.levels.begin(), source.levels.end(), uint8_t{90});
  const DepthMap map = EstimateDepths(scene.Problem(), {});
  EXPECT_EQ(map.face_px, 0);
  EXPECT_THAT(map.problem, ::testing::HasSubstr("the sky alone"));
}

}  // namespace
}  // namespace orbweave
