// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/median_error.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(MedianErrorPx, IsZeroWithoutPointsAndOnCleanRays) {
  const StreetFixture street({.centres = StraightWalk(5, 3.0), .noise_px = 0.0});
  EXPECT_EQ(MedianErrorPx(street.StateWith({0, 1})), 0.0);
  EXPECT_LT(MedianErrorPx(street.TriangulatedStateWith(FirstImages(5))), 1e-6);
}

TEST(MedianErrorPx, GrowsWithTheNoise) {
  // The median of two normal components is 1.177 sigma, a little less once points are fitted.
  for (const double noise_px : {0.3, 0.6}) {
    const StreetFixture street({.centres = StraightWalk(8, 3.0), .noise_px = noise_px});
    const double median_px = MedianErrorPx(street.TriangulatedStateWith(FirstImages(8)));
    EXPECT_GT(median_px, 0.8 * noise_px);
    EXPECT_LT(median_px, 1.25 * noise_px);
  }
}

TEST(MedianErrorPx, TakesPairsWhereThereIsNothingLonger) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0), .noise_px = 0.5});
  const double median_px = MedianErrorPx(street.TriangulatedStateWith({0, 1}));
  EXPECT_GT(median_px, 0.02);
  EXPECT_LT(median_px, 0.6);
}

}  // namespace
}  // namespace orbweave
