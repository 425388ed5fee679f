// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/fuse_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "core/dense/equiangular_raster.h"
#include "core/dense/nearest_points.h"
#include "core/dense/panorama_color.h"
#include "core/dense/tile_grid.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kFace_px = 40;
constexpr EquiangularRaster kRaster = {kFace_px};
const double kAngle = kRaster.PixelAngle();

struct Plane {
  Vector3d normal;  ///< towards the cameras
  double offset;    ///< normal . x = offset
};

/// A street without end: road, two facades, the wall across it.
const std::vector<Plane> kStreet = {{Vector3d::UnitZ(), -2.5},
                                    {-Vector3d::UnitY(), -7.0},
                                    {Vector3d::UnitY(), -6.0},
                                    {-Vector3d::UnitX(), -14.0}};

struct Noise {
  double range_px = 0.15;     ///< of the range, in footprints
  double sigma_factor = 0.3;  ///< of the logarithm of the stated sigma
  double normal_rad = 0.03;
};

/// The street of kStreet as a panorama at `centre` measures it as far as 20 m.
DepthMap MeasureStreet(const Rigid3& cam_from_world, const Noise& noise, Random& random) {
  DepthMap map;
  map.face_px = kFace_px;
  const size_t pixels = kRaster.NumPixels();
  map.range_m.assign(pixels, 0.0F);
  map.normals.assign(pixels, {});
  map.sigma_m.assign(pixels, 0.0F);
  map.views.assign(pixels, 3);
  map.flags.assign(pixels, kDepthChecked);
  for (size_t i = 0; i < pixels; ++i) {
    const int face = static_cast<int>(i / (kFace_px * kFace_px));
    const int row = static_cast<int>(i / kFace_px % kFace_px);
    const int column = static_cast<int>(i % kFace_px);
    const Vector3d ray = cam_from_world.rotation.conjugate() *
                         kRaster.BearingFromPixel(face, row + 0.5, column + 0.5);
    double range = 20.0;
    const Plane* nearest = nullptr;
    for (const Plane& plane : kStreet) {
      const double towards = -plane.normal.dot(ray);
      const double there =
          (plane.normal.dot(cam_from_world.Centre()) - plane.offset) / std::max(1e-9, towards);
      if (towards > 0.05 && there < range) {
        range = there;
        nearest = &plane;
      }
    }
    if (nearest == nullptr) continue;
    const double sigma = noise.range_px * range * kAngle;
    map.range_m[i] = static_cast<float>(range + sigma * random.Normal());
    map.sigma_m[i] = static_cast<float>(sigma * std::exp(noise.sigma_factor * random.Normal()));
    const Vector3d normal = testing::WithNoise(random, nearest->normal, noise.normal_rad);
    map.normals[i] = EncodeNormal((cam_from_world.rotation * normal).cast<float>());
  }
  return map;
}

struct Drive {
  std::vector<DepthMap> maps{};
  std::vector<PosedDepthMap> posed{};
};

Drive MakeDrive(size_t count, const Noise& noise = {}, double step_m = 2.5) {
  Random random(7);
  Drive drive;
  drive.maps.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const Vector3d centre(step_m * static_cast<double>(i), 0.1 * random.Normal(), 0.0);
    const Rigid3 pose = Rigid3::FromCentre(testing::RandomRotation(random), centre);
    drive.maps.push_back(MeasureStreet(pose, noise, random));
    drive.posed.push_back({ImageId{static_cast<uint32_t>(i)}, &drive.maps.back(), pose});
  }
  return drive;
}

/// Of each panorama with those as neighbours that are no farther than `reach` images away.
std::vector<FusedPanorama> FuseAll(const Drive& drive, int reach = 100) {
  std::vector<FusedPanorama> fused;
  for (const PosedDepthMap& own : drive.posed) {
    std::vector<PosedDepthMap> others;
    for (const PosedDepthMap& other : drive.posed) {
      const int apart = std::abs(static_cast<int>(other.image.value - own.image.value));
      if (apart > 0 && apart <= reach) others.push_back(other);
    }
    fused.push_back(FusePixels(own, {}, others));
  }
  return fused;
}

std::vector<SurfacePoint> Together(const std::vector<FusedPanorama>& fused) {
  std::vector<SurfacePoint> all;
  for (const FusedPanorama& one : fused) {
    all.insert(all.end(), one.points.begin(), one.points.end());
  }
  return all;
}

double FootprintOf(const Drive& drive, size_t map, const Vector3d& point) {
  return (point - drive.posed[map].cam_from_world.Centre()).norm() * kAngle;
}

TEST(FusePixels, GivesEveryCheckedPixelOfALonePanorama) {
  Drive drive = MakeDrive(1);
  const auto seen = std::ranges::find_if(drive.maps[0].range_m, [](float r) { return r > 0; });
  drive.maps[0].flags[static_cast<size_t>(seen - drive.maps[0].range_m.begin())] = 0;
  const FusedPanorama fused = FusePixels(drive.posed[0], {}, {});
  const auto held = std::ranges::count_if(drive.maps[0].range_m, [](float r) { return r > 0; });
  EXPECT_EQ(fused.points.size(), static_cast<size_t>(held) - 1);
  EXPECT_EQ(fused.checked_pixels, fused.points.size());
  EXPECT_EQ(fused.problem, "");
  for (const SurfacePoint& point : fused.points) EXPECT_EQ(point.views, 4);
}

TEST(FusePixels, GivesSurfaceOnceThatAllSee) {
  Noise none;
  none.range_px = 0.01;
  none.sigma_factor = 0.0;
  none.normal_rad = 0.0;
  const Drive drive = MakeDrive(4, none, 0.3);  // nearly one place
  const size_t all = Together(FuseAll(drive)).size();
  const size_t alone = FusePixels(drive.posed[0], {}, {}).points.size();
  EXPECT_LT(static_cast<double>(all), 1.5 * static_cast<double>(alone));
  EXPECT_GT(static_cast<double>(all), 0.6 * static_cast<double>(alone));
}

/// No two points of maps that are neighbours come nearer than a third of the smaller footprint.
void ExpectApart(const Drive& drive, int reach) {
  const auto fused = FuseAll(drive, reach);
  for (size_t a = 0; a < fused.size(); ++a) {
    std::vector<Vector3d> points;
    for (const SurfacePoint& point : fused[a].points) points.push_back(point.position_in_world);
    const NearestPoints nearest(points, 1.0);
    for (size_t b = 0; b < fused.size(); ++b) {
      if (b == a || std::abs(static_cast<int>(b) - static_cast<int>(a)) > reach) continue;
      for (const SurfacePoint& point : fused[b].points) {
        const Vector3d& X = point.position_in_world;
        const double footprint = std::min(FootprintOf(drive, a, X), FootprintOf(drive, b, X));
        EXPECT_GT(nearest.DistanceTo(X), footprint / 3.0) << a << " " << b;
      }
    }
  }
}

TEST(FusePixels, KeepsPointsOfDifferentMapsAThirdOfAFootprintApart) {
  ExpectApart(MakeDrive(6), 100);
  ExpectApart(MakeDrive(6), 2);  // maps of one place need not have the same neighbours
  Noise rough;
  rough.range_px = 0.6;
  rough.sigma_factor = 1.0;
  rough.normal_rad = 0.3;
  ExpectApart(MakeDrive(6, rough), 100);
}

/// How far a pixel's point may lie from one that it agrees with, by the widest of the maps there: a
/// pixel across its ray, which a slanted surface lengthens, and three sigma.
double ToleranceAt(const Drive& drive, const SurfacePoint& point) {
  double widest = 0.0;
  for (const PosedDepthMap& posed : drive.posed) {
    const Vector3d ray = point.position_in_world - posed.cam_from_world.Centre();
    const double slant = std::abs(point.normal_in_world.cast<double>().dot(ray.normalized()));
    widest = std::max(widest, ray.norm() * kAngle / std::max(0.05, slant));
  }
  return widest + 3.0 * static_cast<double>(point.sigma_m);
}

TEST(FusePixels, LeavesAPointWithinTwoTolerancesOfEveryCheckedPixel) {
  for (const double sigma_factor : {0.0, 0.3, 1.0}) {
    Noise noise;
    noise.sigma_factor = sigma_factor;
    const Drive drive = MakeDrive(6, noise);
    std::vector<Vector3d> points;
    for (const SurfacePoint& point : Together(FuseAll(drive))) {
      points.push_back(point.position_in_world);
    }
    const NearestPoints nearest(points, 8.0);
    size_t pixels = 0;
    size_t far = 0;
    for (const PosedDepthMap& posed : drive.posed) {
      for (const SurfacePoint& own : FusePixels(posed, {}, {}).points) {
        const double gap = nearest.DistanceTo(own.position_in_world) / ToleranceAt(drive, own);
        EXPECT_LT(gap, 2.0);
        far += gap > 1.0 ? 1 : 0;
        ++pixels;
      }
    }
    EXPECT_LT(static_cast<double>(far), 0.01 * static_cast<double>(pixels)) << sigma_factor;
  }
}

TEST(FusePixels, DoesNotDependOnTheOrderOfNeighbours) {
  const Drive drive = MakeDrive(5);
  std::vector<PosedDepthMap> others(drive.posed.begin() + 1, drive.posed.end());
  const auto points = FusePixels(drive.posed[0], {}, others).points;
  std::ranges::reverse(others);
  EXPECT_EQ(FusePixels(drive.posed[0], {}, others).points, points);
  std::swap(others[0], others[1]);
  EXPECT_EQ(FusePixels(drive.posed[0], {}, others).points, points);
}

/// Root mean squares of the errors of ranges: in footprints, and by their stated sigmas.
std::pair<double, double> ErrorsOf(const Drive& drive, const std::vector<FusedPanorama>& fused) {
  double in_footprints = 0.0;
  double in_sigmas = 0.0;
  double count = 0.0;
  for (size_t i = 0; i < fused.size(); ++i) {
    for (const SurfacePoint& point : fused[i].points) {
      const Vector3d ray = point.position_in_world - drive.posed[i].cam_from_world.Centre();
      if (ray.norm() > 10.0) continue;
      double error = std::numeric_limits<double>::infinity();
      for (const Plane& plane : kStreet) {
        const double off = plane.normal.dot(point.position_in_world) - plane.offset;
        error = std::min(error, std::abs(off / plane.normal.dot(ray.normalized())));
      }
      in_footprints += std::pow(error / (ray.norm() * kAngle), 2);
      in_sigmas += std::pow(error / static_cast<double>(point.sigma_m), 2);
      count += 1.0;
    }
  }
  return {std::sqrt(in_footprints / count), std::sqrt(in_sigmas / count)};
}

TEST(FusePixels, BringsErrorsDownAndClaimsNoMore) {
  Noise noise;
  noise.sigma_factor = 0.0;
  noise.range_px = 0.1;
  const Drive drive = MakeDrive(8, noise, 1.0);
  const auto [alone_px, alone] = ErrorsOf(drive, {FusePixels(drive.posed[0], {}, {})});
  EXPECT_NEAR(alone_px, 0.1, 0.005);
  EXPECT_NEAR(alone, 1.0, 0.05);
  const auto [fused_px, fused] = ErrorsOf(drive, FuseAll(drive));
  EXPECT_LT(fused_px, 0.06);
  EXPECT_LT(fused, 0.8);  // these maps share no errors, as those of images would
  EXPECT_GT(fused, 0.2);
}

TEST(FusePixels, KeepsWhatDisagrees) {
  Drive drive = MakeDrive(2);
  for (float& range : drive.maps[1].range_m) range *= 0.6F;  // another surface, before the first
  const std::vector<PosedDepthMap> second(drive.posed.begin() + 1, drive.posed.end());
  const size_t with = FusePixels(drive.posed[0], {}, second).points.size();
  const size_t alone = FusePixels(drive.posed[0], {}, {}).points.size();
  EXPECT_GT(static_cast<double>(with), 0.97 * static_cast<double>(alone));
}

TEST(FusePixels, MayAskForAgreement) {
  const Drive drive = MakeDrive(5);
  const std::vector<PosedDepthMap> others(drive.posed.begin() + 1, drive.posed.end());
  FuseOptions options;
  size_t last = FusePixels(drive.posed[0], {}, others, options).points.size();
  for (options.min_maps = 2; options.min_maps <= 4; ++options.min_maps) {
    const auto points = FusePixels(drive.posed[0], {}, others, options).points;
    EXPECT_LT(points.size(), last);
    last = points.size();
  }
  EXPECT_GT(last, 0U);
  options.min_maps = 2;
  EXPECT_TRUE(FusePixels(drive.posed[0], {}, {}, options).points.empty());
}

TEST(FusePixels, ClaimsLessWhereMapsScatter) {
  Noise noise;
  noise.sigma_factor = 0.0;
  Drive drive = MakeDrive(5, noise, 0.5);
  const auto mean_sigma = [&] {
    double sum = 0.0;
    const auto points = Together(FuseAll(drive));
    for (const SurfacePoint& point : points) sum += static_cast<double>(point.sigma_m);
    return sum / static_cast<double>(points.size());
  };
  const double stated = mean_sigma();
  for (DepthMap& map : drive.maps) {
    for (float& sigma : map.sigma_m) sigma *= 0.5F;  // half of what errors are
  }
  EXPECT_GT(mean_sigma(), 0.6 * stated);
}

TEST(FusePixels, TurnsWithTheWorld) {
  Random random(5);
  Drive drive = MakeDrive(4);
  const auto before = FuseAll(drive);
  const Rigid3 turn = {testing::RandomRotation(random), Vector3d(300.0, -40.0, 7.0)};
  for (PosedDepthMap& posed : drive.posed) {
    posed.cam_from_world = posed.cam_from_world * turn.Inverse();
  }
  const auto after = FuseAll(drive);
  for (size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(after[i].points.size(), before[i].points.size());
    for (size_t k = 0; k < before[i].points.size(); ++k) {
      const Vector3d expected = turn * before[i].points[k].position_in_world;
      EXPECT_LT((after[i].points[k].position_in_world - expected).norm(), 0.002);
    }
  }
}

TEST(FusePixels, TakesColourFromItsOwnImage) {
  const Drive drive = MakeDrive(1);
  std::vector<uint8_t> pixels(64 * 32 * 3, 0);
  for (size_t i = 0; i < pixels.size(); i += 3) {
    pixels[i] = 200;
    pixels[i + 2] = 7;
  }
  const PanoramaRaster image = {64, 32, 3, pixels, {}};
  for (const SurfacePoint& point : FusePixels(drive.posed[0], image, {}).points) {
    EXPECT_EQ(point.color, (Rgb{200, 0, 7}));
  }
}

TEST(FusePixels, AnswersBrokenInputWithAReason) {
  Drive drive = MakeDrive(2);
  const auto whole = FusePixels(drive.posed[0], {}, {}).points;
  PosedDepthMap broken = drive.posed[1];
  broken.cam_from_world.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FusePixels(broken, {}, {}).problem, "its pose is not finite");
  EXPECT_EQ(FusePixels(drive.posed[0], {}, {{broken}}).points, whole);
  DepthMap empty;
  empty.problem = "all sky";
  broken = {ImageId{9}, &empty, {}};
  EXPECT_EQ(FusePixels(broken, {}, {}).problem, "all sky");
  EXPECT_EQ(FusePixels(drive.posed[0], {}, {{broken}}).points, whole);
  std::ranges::fill(drive.maps[0].flags, uint8_t{0});
  EXPECT_NE(FusePixels(drive.posed[0], {}, {}).problem, "");
  std::ranges::fill(drive.maps[0].flags, kDepthChecked);
  std::ranges::fill(drive.maps[0].range_m, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(FusePixels(drive.posed[0], {}, {}).points.empty());
}

TEST(FusePixels, GivesTheSamePointsWhateverTheTiles) {
  auto points = Together(FuseAll(MakeDrive(4)));
  std::vector<std::multiset<std::tuple<double, double, double, float>>> sets;
  for (const double cell_m : {4.0, 8.0, 1000.0}) {
    const TileGrid grid = {cell_m};
    auto& set = sets.emplace_back();
    size_t end = 0;
    for (const TileRun& run : GroupByTile(grid, points)) {
      EXPECT_EQ(run.begin, end);
      end += run.count;
      for (size_t i = run.begin; i < end; ++i) {
        const Vector3d& X = points[i].position_in_world;
        EXPECT_EQ(grid.CellOf(X), run.cell);
        set.emplace(X.x(), X.y(), X.z(), points[i].sigma_m);
      }
    }
    EXPECT_EQ(end, points.size());
  }
  EXPECT_EQ(sets[0], sets[1]);
  EXPECT_EQ(sets[0], sets[2]);
}

TEST(ColorAlong, IsBilinearAndPeriodic) {
  const std::vector<uint8_t> pixels = {0, 100, 200, 40, 0, 100, 200, 40};  // 4 x 2, grey
  const PanoramaRaster image = {4, 2, 1, pixels, {}};
  EXPECT_EQ(ColorAlong(image, Vector3d::UnitZ()), (Rgb{150, 150, 150}));
  EXPECT_EQ(ColorAlong(image, -Vector3d::UnitZ()), (Rgb{20, 20, 20}));
  EXPECT_EQ(ColorAlong({}, Vector3d::UnitZ()), Rgb{});
}

}  // namespace
}  // namespace orbweave
