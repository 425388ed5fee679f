// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/remove_speckles.h"

#include <gtest/gtest.h>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

TEST(RemoveSpeckles, TakesSmallSurfacesAwayAndLeavesLargeOnes) {
  constexpr EquiangularRaster kRaster = {32};
  DepthMap map{.face_px = 32};
  map.range_m.assign(kRaster.NumPixels(), 5.0F);
  const auto paint = [&](int face, int row, int column, int size, float range_m) {
    for (int r = row; r < row + size; ++r) {
      for (int c = column; c < column + size; ++c) map.range_m[kRaster.Index(face, r, c)] = range_m;
    }
  };
  paint(2, 4, 4, 3, 3.0F);    // 9 pixels
  paint(2, 12, 12, 6, 3.0F);  // 36 pixels
  RemoveSpeckles(30, map);
  EXPECT_EQ(map.range_m[kRaster.Index(2, 5, 5)], 0.0F);
  EXPECT_EQ(map.range_m[kRaster.Index(2, 14, 14)], 3.0F);
  EXPECT_EQ(map.range_m[kRaster.Index(2, 0, 0)], 5.0F);
}

}  // namespace
}  // namespace orbweave
