// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/trim_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kSize = 48;
constexpr int kEdge = 24;    ///< first column that is not the surface's
constexpr int kCarried = 2;  ///< pixels by which its range goes on
constexpr int kFace = 2;
constexpr int kMargin = 8;  ///< of what surroundings on other faces may change
constexpr int kRows = kSize - 2 * kMargin;

/// A dark surface 5 m away left of an edge, and something bright right of it.
struct Scene {
  ReferenceRaster raster{.face_px = kSize};
  DepthMap map{.face_px = kSize};

  PlaneField field{kSize};

  explicit Scene(float behind_m, double behind_level = 180.0) {
    SetCosts(0.1F);
    Random random(1);
    const auto stride = static_cast<size_t>(raster.Stride());
    for (auto& levels : raster.levels) {
      for (size_t k = 0; k < stride * stride; ++k) {
        const int column = static_cast<int>(k % stride) - ReferenceRaster::kApron_px;
        const double level = column < kEdge ? 60.0 : behind_level;
        levels.push_back(static_cast<uint8_t>(level + random.Uniform(-8.0, 8.0)));
      }
    }
    for (size_t k = 0; k < EquiangularRaster{kSize}.NumPixels(); ++k)
      map.range_m.push_back(static_cast<int>(k % kSize) < kEdge + kCarried ? 5.0F : behind_m);
    map.flags.assign(map.range_m.size(), 0);
  }

  void SetCosts(float cost) { std::ranges::fill(field.cost, cost); }

  void Trim() { TrimEdges(raster, field, map); }

  /// Pixels of a column of the face that have a range near 5 m, of kRows away from other faces.
  [[nodiscard]] int CountAt(int column) const {
    int count = 0;
    for (int row = kMargin; row < kMargin + kRows; ++row) {
      const float range = map.range_m[EquiangularRaster{kSize}.Index(kFace, row, column)];
      count += range > 4.0F && range < 6.0F ? 1 : 0;
    }
    return count;
  }
};

TEST(TrimEdges, TakesAwayWhatIsCarriedIntoTheSky) {
  Scene scene(0.0F);
  scene.Trim();
  for (int column = kMargin; column < kEdge; ++column)
    EXPECT_EQ(scene.CountAt(column), kRows) << column;
  for (int column = kEdge; column < kEdge + kCarried; ++column)
    EXPECT_LT(scene.CountAt(column), kRows / 10) << column;
}

TEST(TrimEdges, TakesAwayWhatIsCarriedOverAWallFartherAway) {
  Scene scene(9.0F);
  scene.Trim();
  EXPECT_EQ(scene.CountAt(kEdge - 1), kRows);
  EXPECT_EQ(scene.CountAt(kEdge), 0);
  const size_t wall = EquiangularRaster{kSize}.Index(kFace, 9, kEdge + kCarried);
  EXPECT_EQ(scene.map.range_m[wall], 9.0F);
}

TEST(TrimEdges, LeavesASurfaceAloneThatEndsWhereItsColourDoes) {
  Scene scene(0.0F);
  for (size_t k = 0; k < scene.map.range_m.size(); ++k) {
    if (static_cast<int>(k % kSize) >= kEdge) scene.map.range_m[k] = 0.0F;
  }
  scene.Trim();
  for (int column = kMargin; column < kEdge; ++column)
    EXPECT_EQ(scene.CountAt(column), kRows) << column;
}

TEST(TrimEdges, LeavesWhatIsSureBesideAHoleInOneTexture) {
  Scene scene(0.0F, 60.0);
  scene.Trim();
  for (int column = kMargin; column < kEdge; ++column)
    EXPECT_EQ(scene.CountAt(column), kRows) << column;
  scene.SetCosts(0.4F);
  scene.Trim();
  EXPECT_LT(scene.CountAt(kEdge + kCarried - 1), kRows);
  EXPECT_EQ(scene.CountAt(kEdge - 3), kRows);
}

TEST(TrimEdges, DoesNotTakeWhatIsMaskedForWhatLiesBehind) {
  Scene scene(0.0F);
  const auto stride = static_cast<size_t>(scene.raster.Stride());
  for (auto& ignored : scene.raster.ignored) {
    for (size_t k = 0; k < stride * stride; ++k) {
      const int column = static_cast<int>(k % stride) - ReferenceRaster::kApron_px;
      ignored.push_back(column >= kEdge + kCarried ? 1 : 0);
    }
  }
  scene.Trim();
  for (int column = kMargin; column < kEdge; ++column)
    EXPECT_EQ(scene.CountAt(column), kRows) << column;
}

}  // namespace
}  // namespace orbweave
