// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/match_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/random.h"
#include "core/dense/reference_raster.h"
#include "core/dense/source_faces.h"
#include "core/geometry/rigid3.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr float kNoise = 0.5F;

/// Smooth levels all over the sphere, with a little noise.
GreyPanorama MakeTexture(int width_px, uint64_t seed, bool with_mask) {
  Random random(seed);
  std::vector<uint8_t> levels;
  std::vector<uint8_t> ignored;
  for (int row = 0; row < width_px / 2; ++row) {
    for (int column = 0; column < width_px; ++column) {
      const double wave = 60.0 * std::sin(0.31 * column + 0.2 * row) * std::cos(0.27 * row);
      levels.push_back(static_cast<uint8_t>(128.0 + wave + random.Uniform(0.0, 40.0)));
      ignored.push_back(column > width_px / 3 && column < width_px / 2 ? 1 : 0);
    }
  }
  PanoramaRaster raster{.width_px = width_px, .height_px = width_px / 2, .pixels = levels};
  if (with_mask) raster.ignored = ignored;
  return MakeGreyPanorama(raster);
}

struct Scene {
  explicit Scene(bool with_mask)
      : raster(MakeReferenceRaster(MakeTexture(256, 1, false))),
        faces(MakeSourceFaces(MakeSourceFaceMap(256), MakeTexture(256, 1, with_mask))) {}

  [[nodiscard]] MatchView View(const Rigid3& source_from_face) const {
    MatchView view{.quads = faces.quads.data(),
                   .size_px = faces.size_px,
                   .focal_px = faces.focal_px,
                   .ignored = faces.ignored.empty() ? nullptr : faces.ignored.data(),
                   .tiles = faces.tiles};
    const Eigen::Matrix3d R = source_from_face.rotation.toRotationMatrix();
    for (int k = 0; k < 9; ++k) view.rotation[k] = static_cast<float>(R(k / 3, k % 3));
    for (int k = 0; k < 3; ++k)
      view.translation[k] = static_cast<float>(source_from_face.translation[k]);
    return view;
  }

  [[nodiscard]] ReferencePatches Patches(int row, int column) const {
    ReferencePatches patches;
    const int stride = raster.Stride();
    const int apron = ReferenceRaster::kApron_px;
    PreparePatches(&raster.levels[0][static_cast<size_t>((row + apron) * stride + column + apron)],
                   stride,
                   patches);
    patches.y = raster.tangents[static_cast<size_t>(row + apron)];
    patches.dy = raster.tangent_steps[static_cast<size_t>(row + apron)];
    for (size_t k = 0; k < kMatchLanes; ++k) {
      const size_t at = static_cast<size_t>(column + apron) + 2 * k;
      patches.x[k] = raster.tangents[at];
      patches.dx[k] = raster.tangent_steps[at];
    }
    return patches;
  }

  ReferenceRaster raster;
  SourceFaces faces;
};

PlaneLanes RandomPlanes(Random& random) {
  PlaneLanes planes;
  for (size_t k = 0; k < kMatchLanes; ++k) {
    planes.x[k] = static_cast<float>(random.Normal() * 0.2);
    planes.y[k] = static_cast<float>(random.Normal() * 0.2);
    planes.z[k] = static_cast<float>(random.Uniform(-0.05, 0.8));
  }
  return planes;
}

TEST(MatchKernel, GivesTheSameBytesOnEveryInstructionSet) {
  const std::vector<MatchKernel> kernels = AvailableMatchKernels();
  for (const bool with_mask : {false, true}) {
    const Scene scene(with_mask);
    Random random(7);
    for (int trial = 0; trial < 300; ++trial) {
      const Rigid3 pose{testing::RandomRotation(random), testing::RandomDirection(random)};
      const MatchView view = scene.View(pose);
      const ReferencePatches patches =
          scene.Patches(static_cast<int>(random.Index(64)), static_cast<int>(random.Index(32)));
      const PlaneLanes planes = RandomPlanes(random);
      LaneFloats expected{};
      MatchFunctionOf(MatchKernel::kPortable)(patches, view, planes, kNoise, expected);
      for (const MatchKernel kernel : kernels) {
        LaneFloats found{};
        MatchFunctionOf(kernel)(patches, view, planes, kNoise, found);
        ASSERT_EQ(std::memcmp(found.data(), expected.data(), sizeof(found)), 0)
            << "kernel " << static_cast<int>(kernel) << " trial " << trial;
      }
    }
  }
}

TEST(MatchKernel, FindsAPanoramaEqualToItselfWhicheverWayTheSourceIsTurned) {
  const Scene scene(false);
  Random random(3);
  PlaneLanes far;
  far.z.fill(1e-6F);
  for (int face = 0; face < kCubeFaces; ++face) {
    const Rigid3 turn{Eigen::Quaterniond(FaceFromCamera(face)).conjugate(), {0.0, 0.0, 0.0}};
    for (const int row : {0, 20, 63}) {
      ReferencePatches patches = scene.Patches(row, 10);
      const int stride = scene.raster.Stride();
      const int apron = ReferenceRaster::kApron_px;
      PreparePatches(&scene.raster.levels[static_cast<size_t>(face)]
                                         [static_cast<size_t>((row + apron) * stride + 10 + apron)],
                     stride,
                     patches);
      LaneFloats zncc{};
      MatchFunctionOf(MatchKernel::kPortable)(patches, scene.View(turn), far, kNoise, zncc);
      for (const float score : zncc) EXPECT_GT(score, 0.9F) << "face " << face << " row " << row;
    }
  }
}

TEST(MatchKernel, HasNoMatchWhereTheSourceIgnoresThePlace) {
  const Scene scene(true);
  PlaneLanes far;
  far.z.fill(1e-6F);
  LaneFloats zncc{};
  // Columns 85 to 128 of 256 are ignored: the left half of the front face.
  MatchFunctionOf(MatchKernel::kPortable)(scene.Patches(30, 0), scene.View({}), far, kNoise, zncc);
  for (size_t k = 0; k < 16; ++k) EXPECT_EQ(zncc[k], kNoMatch) << k;
}

TEST(PreparePatches, WeighsTapsLikeTheMiddleMoreThanOthers) {
  std::vector<uint8_t> levels(100 * 100, 100);
  for (size_t k = 0; k < levels.size(); ++k) {
    if (k % 100 > 50) levels[k] = 200;
  }
  ReferencePatches patches;
  PreparePatches(&levels[50 * 100 + 40], 100, patches);
  EXPECT_NEAR(patches.mean[0], 100.0F, 1e-3F);  // the edge is eleven pixels away
  EXPECT_EQ(patches.scatter[0], 0.0F);
  EXPECT_LT(patches.mean[4], 120.0F);  // column 48: half of the patch is 200
  EXPECT_GT(patches.mean[4], 100.0F);
}

}  // namespace
}  // namespace orbweave
