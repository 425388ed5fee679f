// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/ground_texture.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr double kPixel_m = 0.02;

/// Mean brightness along the street at a distance from the lane's axis.
double MeanBrightness(const StreetLayout& layout, double from_axis_m) {
  double sum = 0.0;
  int count = 0;
  for (double s = 0.0; s < layout.axis.length_m(); s += 0.05, ++count) {
    const PathPlace place = layout.axis.At(s);
    sum += GroundColour(layout, place.position + from_axis_m * place.Left(), kPixel_m, 3).mean();
  }
  return sum / count;
}

TEST(GroundTexture, LaneMarksAreBrighterThanAsphaltAndKerbsBrighterThanBoth) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  const double asphalt = MeanBrightness(layout, 0.8);
  const double mark = MeanBrightness(layout, StreetProfile::kLaneMark_m);
  EXPECT_GT(mark, asphalt + 0.1);
  EXPECT_GT(MeanBrightness(layout, StreetProfile::kOuterKerb_m + 0.09), mark);
}

TEST(GroundTexture, HasFineDetailThatFadesWithTheFootprint) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  const auto change = [&](double footprint_m) {
    double sum = 0.0;
    for (int k = 0; k < 500; ++k) {
      const Eigen::Vector2d place(0.031 * k - 8.0, layout.half_m.y() + 0.4);
      sum += (GroundColour(layout, place, footprint_m, 3) -
              GroundColour(layout, place + Eigen::Vector2d(0.03, 0.0), footprint_m, 3))
                 .norm();
    }
    return sum;
  };
  EXPECT_GT(change(0.005), 4.0 * change(0.3));
}

}  // namespace
}  // namespace orbweave
