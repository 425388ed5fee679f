// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/check_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"
#include "tests/core/dense/box_world.h"

namespace orbweave {
namespace {

constexpr int kFace_px = 64;

Rigid3 PoseAt(double x_m) {
  return Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {x_m, 0.1 * x_m, 0.05});
}

/// The true map of the box from a pose, with sigmas of 1 % and noise of as much.
DepthMap TrueMap(const Rigid3& cam_from_box, double noise) {
  const EquiangularRaster raster{kFace_px};
  Random random(static_cast<uint64_t>(1000.0 * (cam_from_box.translation.x() + 5.0)));
  DepthMap map{.face_px = kFace_px};
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < kFace_px; ++row) {
      for (int column = 0; column < kFace_px; ++column) {
        const Eigen::Vector3d bearing = raster.BearingFromPixel(face, row + 0.5, column + 0.5);
        const Eigen::Vector3d direction = cam_from_box.rotation.conjugate() * bearing;
        const double range_m = testing::RangeInBox(cam_from_box.Centre(), direction);
        const Eigen::Vector3d point = cam_from_box.Centre() + range_m * direction;
        map.range_m.push_back(static_cast<float>(range_m * (1.0 + noise * 0.01 * random.Normal())));
        map.sigma_m.push_back(static_cast<float>(0.01 * range_m));
        map.normals.push_back(
            EncodeNormal((cam_from_box.rotation * testing::NormalInBox(point)).cast<float>()));
        map.views.push_back(0);
        map.flags.push_back(0);
      }
    }
  }
  return map;
}

/// Own map at the middle, neighbours at both sides.
struct Maps {
  explicit Maps(double noise) : own(TrueMap(PoseAt(0.0), noise)) {
    for (const double x_m : {-1.2, -0.6, 0.6, 1.2}) {
      maps.push_back(TrueMap(PoseAt(x_m), noise));
      poses.push_back(PoseAt(x_m) * PoseAt(0.0).Inverse());
    }
  }

  [[nodiscard]] std::vector<NeighbourMap> Neighbours() const {
    std::vector<NeighbourMap> neighbours;
    for (size_t k = 0; k < maps.size(); ++k) neighbours.push_back({&maps[k], poses[k]});
    return neighbours;
  }

  DepthMap own;
  std::vector<DepthMap> maps{};
  std::vector<Rigid3> poses{};
};

double ShareKept(const DepthMap& map) {
  return static_cast<double>(
             std::ranges::count_if(map.range_m, [](float range_m) { return range_m > 0.0F; })) /
         static_cast<double>(map.size());
}

TEST(CheckDepths, KeepsWhatAllMapsSee) {
  const Maps maps(0.0);
  const DepthMap checked = CheckDepths(maps.own, maps.Neighbours(), {});
  EXPECT_GT(ShareKept(checked), 0.97);
  for (size_t k = 0; k < checked.size(); ++k) {
    if (!(checked.range_m[k] > 0.0F)) continue;
    EXPECT_NEAR(checked.range_m[k] / maps.own.range_m[k], 1.0F, 0.011F);
    EXPECT_GT(checked.views[k], 0);
    EXPECT_NE(checked.flags[k] & kDepthChecked, 0);
  }
}

TEST(CheckDepths, AveragesNoiseAway) {
  const Maps maps(1.0);
  const Maps truth(0.0);
  const DepthMap checked = CheckDepths(maps.own, maps.Neighbours(), {});
  double before = 0.0;
  double after = 0.0;
  for (size_t k = 0; k < checked.size(); ++k) {
    if (!(checked.range_m[k] > 0.0F)) continue;
    before += std::pow(maps.own.range_m[k] / truth.own.range_m[k] - 1.0F, 2.0F);
    after += std::pow(checked.range_m[k] / truth.own.range_m[k] - 1.0F, 2.0F);
  }
  EXPECT_LT(after, 0.5 * before);
}

double MedianSigma(const DepthMap& map) {
  std::vector<double> sigmas;
  for (size_t k = 0; k < map.size(); ++k) {
    if (map.range_m[k] > 0.0F)
      sigmas.push_back(static_cast<double>(map.sigma_m[k] / map.range_m[k]));
  }
  std::ranges::nth_element(sigmas, sigmas.begin() + static_cast<ptrdiff_t>(sigmas.size() / 2));
  return sigmas[sigmas.size() / 2];
}

/// Ten errors of a normal distribution, each as likely as the others.
constexpr std::array kDeciles = {
    -1.645, -1.036, -0.674, -0.385, -0.126, 0.126, 0.385, 0.674, 1.036, 1.645};

/// What 0.05 pixels of the largest parallax make of the ranges of a map.
std::vector<float> BiasesOf(const Maps& maps) {
  const EquiangularRaster raster{kFace_px};
  std::vector<float> biases_m;
  for (size_t k = 0; k < maps.own.size(); ++k) {
    const auto pixel = static_cast<int>(k);
    const Eigen::Vector3d bearing = raster.BearingFromPixel(
        pixel / (kFace_px * kFace_px), pixel / kFace_px % kFace_px + 0.5, pixel % kFace_px + 0.5);
    double least_m = 1e9;
    for (const Rigid3& pose : maps.poses) {
      const Eigen::Vector3d ray =
          static_cast<double>(maps.own.range_m[k]) * bearing - pose.Centre();
      least_m = std::min(least_m, ray.squaredNorm() / bearing.cross(ray).norm());
    }
    biases_m.push_back(static_cast<float>(0.05 * raster.PixelAngle() * least_m));
  }
  return biases_m;
}

/// Maps whose errors are as large as they claim, half of the variance the same factor for all.
Maps MapsThatShareHalf(double common) {
  const double half = std::sqrt(0.5);
  Maps maps(half);
  const auto factor = static_cast<float>(1.0 + 0.01 * half * common);
  for (float& range_m : maps.own.range_m) range_m *= factor;
  for (DepthMap& map : maps.maps) {
    for (float& range_m : map.range_m) range_m *= factor;
  }
  return maps;
}

TEST(CheckDepths, StatesSigmasThatErrorsKeepWhereMapsShareHalfOfThem) {
  const Maps truth(0.0);
  const std::vector<float> biases_m = BiasesOf(truth);
  std::array<double, 2> within{};
  double count = 0.0;
  for (const double common : kDeciles) {
    const Maps maps = MapsThatShareHalf(common);
    const DepthMap checked = CheckDepths(maps.own, maps.Neighbours(), {});
    for (size_t k = 0; k < checked.size(); ++k) {
      if (!(checked.range_m[k] > 0.0F)) continue;
      for (const double bias : kDeciles) {
        const float error_m = std::abs(checked.range_m[k] - truth.own.range_m[k] +
                                       static_cast<float>(bias) * biases_m[k]);
        within[0] += error_m < checked.sigma_m[k] ? 1.0 : 0.0;
        within[1] += error_m < 2.0F * checked.sigma_m[k] ? 1.0 : 0.0;
        count += 1.0;
      }
    }
  }
  EXPECT_NEAR(within[0] / count, 0.68, 0.05);
  EXPECT_NEAR(within[1] / count, 0.95, 0.05);
}

TEST(CheckDepths, BelievesRangesAsMuchAsTheyAgree) {
  const auto sigma_at = [](double noise) {
    const Maps maps(noise);
    return MedianSigma(CheckDepths(maps.own, maps.Neighbours(), {}));
  };
  // Of five ranges of 1 %, by the sum of VarianceOfMean(5) = 0.6 and what the bias makes.
  EXPECT_LT(sigma_at(0.0), 0.007);
  EXPECT_GT(sigma_at(1.0), 0.009);
}

TEST(CheckDepths, DropsWhatOneMapAloneSees) {
  Maps maps(0.0);
  const EquiangularRaster raster{kFace_px};
  for (int row = 20; row < 40; ++row) {
    for (int column = 20; column < 40; ++column) {
      maps.own.range_m[raster.Index(0, row, column)] *= 0.5F;  // through which others see the wall
      maps.own.range_m[raster.Index(1, row, column)] *= 1.6F;  // behind the wall
    }
  }
  const DepthMap checked = CheckDepths(maps.own, maps.Neighbours(), {});
  for (int row = 20; row < 40; ++row) {
    for (int column = 20; column < 40; ++column) {
      EXPECT_EQ(checked.range_m[raster.Index(0, row, column)], 0.0F);
      EXPECT_EQ(checked.range_m[raster.Index(1, row, column)], 0.0F);
    }
  }
}

TEST(CheckDepths, AsksForAsManyAsItIsTold) {
  Maps maps(0.0);
  for (size_t k = 1; k < 4; ++k)
    std::fill(maps.maps[k].range_m.begin(), maps.maps[k].range_m.end(), 0.0F);
  EXPECT_GT(ShareKept(CheckDepths(maps.own, maps.Neighbours(), {.min_agreeing = 1})), 0.7);
  EXPECT_EQ(ShareKept(CheckDepths(maps.own, maps.Neighbours(), {.min_agreeing = 2})), 0.0);
}

/// Of four neighbours the last `count` have everything at a multiple of its range.
Maps WithRangesTimes(float factor, size_t count) {
  Maps maps(0.0);
  for (size_t k = maps.maps.size() - count; k < maps.maps.size(); ++k) {
    for (float& range_m : maps.maps[k].range_m) range_m *= factor;
  }
  return maps;
}

TEST(CheckDepths, DropsWhatMostMapsDeny) {
  const Maps halves = WithRangesTimes(0.9F, 2);
  EXPECT_GT(ShareKept(CheckDepths(halves.own, halves.Neighbours(), {})), 0.9);
  const Maps most = WithRangesTimes(0.9F, 3);
  EXPECT_LT(ShareKept(CheckDepths(most.own, most.Neighbours(), {})), 0.1);
  EXPECT_GT(ShareKept(CheckDepths(most.own, most.Neighbours(), {.min_agreeing_share = 0.25})), 0.9);
}

TEST(CheckDepths, DoesNotAskWhoSeesSomethingBefore) {
  const Maps hidden = WithRangesTimes(0.5F, 3);
  EXPECT_GT(ShareKept(CheckDepths(hidden.own, hidden.Neighbours(), {})), 0.7);
}

TEST(CheckDepths, DoesNotAskWhoIsMuchFartherAway) {
  Maps maps(0.0);
  for (size_t k = 1; k < 4; ++k) {
    maps.poses[k].translation *= 40.0;
    const auto before_m = static_cast<float>(0.85 * maps.poses[k].translation.norm());
    std::ranges::fill(maps.maps[k].range_m, before_m);
  }
  EXPECT_GT(ShareKept(CheckDepths(maps.own, maps.Neighbours(), {})), 0.7);
}

TEST(CheckDepths, OneNeighbourIsEnough) {
  const Maps maps(0.0);
  const DepthMap checked = CheckDepths(maps.own, {maps.Neighbours().front()}, {});
  EXPECT_GT(ShareKept(checked), 0.9);
}

TEST(CheckDepths, LeavesEmptyMapsAndForeignSizesAlone) {
  const Maps maps(0.0);
  const DepthMap empty{.problem = "no source"};
  EXPECT_EQ(CheckDepths(empty, maps.Neighbours(), {}).problem, "no source");
  const std::vector<NeighbourMap> strange = {{&empty, {}}, {nullptr, {}}};
  EXPECT_EQ(ShareKept(CheckDepths(maps.own, strange, {.min_agreeing = 1})), 1.0);
}

}  // namespace
}  // namespace orbweave
