// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/spread_choice.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ChooseSpread, TakesTheFarthestNext) {
  const std::vector<Vector3d> bearings = {Vector3d::UnitX(),
                                          Vector3d(0.99, 0.1, 0.0).normalized(),
                                          Vector3d::UnitY(),
                                          -Vector3d::UnitX()};
  EXPECT_THAT(ChooseSpread(bearings, 3), ElementsAre(0, 3, 2));
}

TEST(ChooseSpread, TakesEachOnceEvenIfAllAreEqual) {
  const std::vector<Vector3d> bearings(4, Vector3d::UnitZ());
  EXPECT_THAT(ChooseSpread(bearings, 10), ElementsAre(0, 1, 2, 3));
}

TEST(ChooseSpread, OfNothingTakesNothing) { EXPECT_THAT(ChooseSpread({}, 3), IsEmpty()); }

}  // namespace
}  // namespace orbweave
