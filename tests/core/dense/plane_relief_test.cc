// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kFace_px = 256;
constexpr int kPatch_px = 11;
constexpr double kError_m = 0.02;

/// Points of the front face: errors that pixels of a patch share, and what a surface adds.
template <typename SurfaceAt>
std::vector<PlaneResidual> Residuals(SurfaceAt&& surface_at, float weight = 2500.0F) {
  constexpr int kPatches = kFace_px / kPatch_px + 1;
  Random random(3);
  std::vector<double> errors_m;
  for (int k = 0; k < kPatches * kPatches; ++k) errors_m.push_back(kError_m * random.Normal());
  std::vector<PlaneResidual> residuals;
  for (int row = 0; row < kFace_px; ++row) {
    for (int column = 0; column < kFace_px; ++column) {
      const int patch = row / kPatch_px * kPatches + column / kPatch_px;
      const double off_m = errors_m[static_cast<size_t>(patch)] + surface_at(row, column);
      residuals.push_back({static_cast<uint32_t>(EquiangularRaster{kFace_px}.Index(0, row, column)),
                           static_cast<float>(off_m),
                           weight});
    }
  }
  return residuals;
}

double ReliefIn(const std::vector<PlaneResidual>& residuals) {
  const auto relief = ReliefOf(kFace_px, residuals);
  EXPECT_TRUE(relief.has_value());
  return relief ? std::sqrt(relief->variance_m2) : -1.0;
}

double Flat(int /*row*/, int /*column*/) { return 0.0; }
/// Two houses, one 2 cm before the other.
double Step(int /*row*/, int column) { return column < kFace_px / 2 ? -0.01 : 0.01; }
/// Houses of a street that bends: each 4 cells wide, turned to the plane.
double Saw(int /*row*/, int column) { return 0.03 * (column % 64 - 31.5) / 31.5; }

TEST(ReliefOf, IsNotWhatPatchesErr) { EXPECT_LT(ReliefIn(Residuals(Flat)), 0.25 * kError_m); }

TEST(ReliefOf, FindsHalfAsMuchAsPatchesErr) { EXPECT_NEAR(ReliefIn(Residuals(Step)), 0.01, 0.002); }

TEST(ReliefOf, FindsTheTeethOfASaw) {
  EXPECT_NEAR(ReliefIn(Residuals(Saw)), 0.03 / std::sqrt(3.0), 0.003);
}

TEST(ReliefOf, DoesNotDependOnWhatPointsClaim) {
  EXPECT_NEAR(ReliefIn(Residuals(Step, 1.0F)), ReliefIn(Residuals(Step, 1e6F)), 1e-6);
}

TEST(ReliefOf, TurnsWithTheFace) {
  const auto turned = [](int row, int column) { return Saw(column, row); };
  EXPECT_NEAR(ReliefIn(Residuals(turned)), ReliefIn(Residuals(Saw)), 0.003);
}

TEST(ReliefOf, IsUnknownWithoutTwoPlacesToCompare) {
  EXPECT_FALSE(ReliefOf(kFace_px, {}).has_value());
  const std::vector<PlaneResidual> one = {{.pixel = 5, .off_m = 0.1F, .weight = 1.0F}};
  EXPECT_FALSE(ReliefOf(kFace_px, one).has_value());
}

}  // namespace
}  // namespace orbweave
