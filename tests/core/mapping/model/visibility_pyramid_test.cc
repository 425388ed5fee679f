// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/visibility_pyramid.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

Eigen::Vector3d RandomBearing(Random& random) {
  return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
}

TEST(VisibilityPyramid, CellsHaveEqualArea) {
  Random random(3);
  constexpr int kSamples = 64000;
  std::vector<int> counts(64, 0);
  for (int i = 0; i < kSamples; ++i) ++counts[VisibilityPyramid::CellOf(RandomBearing(random))];
  for (const int count : counts)
    EXPECT_NEAR(count, kSamples / 64, 5.0 * std::sqrt(kSamples / 64.0));
}

TEST(VisibilityPyramid, SeamAndPolesAreCellsLikeOthers) {
  for (const Eigen::Vector3d& bearing : {Eigen::Vector3d(0, 1, 0),
                                         Eigen::Vector3d(0, -1, 0),
                                         Eigen::Vector3d(0, 0, -1),
                                         Eigen::Vector3d(-0.0, 0, -1)}) {
    EXPECT_LT(VisibilityPyramid::CellOf(bearing), 64);
  }
}

TEST(VisibilityPyramid, PrefersSpreadToCrowding) {
  VisibilityPyramid crowded;
  VisibilityPyramid spread;
  for (int i = 0; i < 64; ++i) crowded.Add(27);
  for (uint8_t cell = 0; cell < 64; cell += 8) spread.Add(cell);
  EXPECT_GT(crowded.Count(), spread.Count());
  EXPECT_GT(spread.Score(), crowded.Score());
}

TEST(VisibilityPyramid, FullSphereHasTheFullScore) {
  VisibilityPyramid pyramid;
  for (uint8_t cell = 0; cell < 64; ++cell) pyramid.Add(cell);
  EXPECT_EQ(pyramid.Score(), 4U * 4U + 16U * 16U + 64U * 64U);
}

TEST(VisibilityPyramid, RemoveUndoesAdd) {
  Random random(5);
  VisibilityPyramid pyramid;
  std::vector<uint8_t> cells;
  for (int i = 0; i < 200; ++i) cells.push_back(VisibilityPyramid::CellOf(RandomBearing(random)));
  std::vector<uint32_t> scores;
  for (const uint8_t cell : cells) {
    scores.push_back(pyramid.Score());
    pyramid.Add(cell);
  }
  for (size_t i = cells.size(); i-- > 0;) {
    pyramid.Remove(cells[i]);
    EXPECT_EQ(pyramid.Score(), scores[i]);
  }
  EXPECT_EQ(pyramid.Count(), 0U);
}

}  // namespace
}  // namespace orbweave
