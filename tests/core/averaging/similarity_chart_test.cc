// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/similarity_chart.h"

#include <gtest/gtest.h>

#include "tests/core/averaging/similarity_samples.h"

namespace orbweave {
namespace {

SimilarityChart RandomChart(Random& random) {
  return {.a_from_b = testing::RandomSimilarity(random),
          .anchor_in_b = testing::RandomPoint(random, 0.0, 10.0),
          .length_in_a = random.Uniform(0.5, 20.0)};
}

TEST(SimilarityChart, GoesThereAndBack) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const SimilarityChart chart = RandomChart(random);
    const Vector7d x = testing::RandomVector7(random, 0.4);
    EXPECT_LT((chart.Of(chart.At(x)) - x).norm(), 1e-9);
  }
}

TEST(SimilarityChart, HasItsOwnSimilarityAtZero) {
  Random random(2);
  const SimilarityChart chart = RandomChart(random);
  EXPECT_LT(chart.Of(chart.a_from_b).norm(), 1e-12);
}

TEST(SimilarityChart, LeavesTheAnchorInPlaceWhenTurningAndGrowing) {
  Random random(3);
  const SimilarityChart chart = RandomChart(random);
  Vector7d x = testing::RandomVector7(random, 0.5);
  x.tail<3>().setZero();
  EXPECT_LT((chart.At(x) * chart.anchor_in_b - chart.a_from_b * chart.anchor_in_b).norm(), 1e-9);
}

TEST(SimilarityChart, DoesNotDependOnTheFrameOfB) {
  Random random(4);
  const SimilarityChart chart = RandomChart(random);
  const Sim3 b_from_c = testing::RandomSimilarity(random);
  const SimilarityChart moved{.a_from_b = chart.a_from_b * b_from_c,
                              .anchor_in_b = b_from_c.Inverse() * chart.anchor_in_b,
                              .length_in_a = chart.length_in_a};
  const Sim3 other = chart.At(testing::RandomVector7(random, 0.3));
  EXPECT_LT((chart.Of(other) - moved.Of(other * b_from_c)).norm(), 1e-9);
}

}  // namespace
}  // namespace orbweave
