// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/quantile.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

std::vector<double> SomeValues(size_t count) {
  Random random(count);
  std::vector<double> values(count);
  for (double& value : values) value = random.Normal();
  return values;
}

TEST(ValueOfRank, IsThatOfTheSortedValues) {
  for (const size_t count : {1U, 2U, 7U, 100U}) {
    std::vector<double> sorted = SomeValues(count);
    std::ranges::sort(sorted);
    for (size_t rank = 0; rank < count; ++rank)
      EXPECT_EQ(ValueOfRank(SomeValues(count), rank), sorted[rank]);
  }
}

TEST(UpperMedian, IsTheUpperOfTwoInTheMiddle) {
  EXPECT_EQ(UpperMedian({5.0}), 5.0);
  EXPECT_EQ(UpperMedian({5.0, 1.0}), 5.0);
  EXPECT_EQ(UpperMedian({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(UpperMedian({4.0, 1.0, 3.0, 2.0}), 3.0);
}

TEST(Quantile, IsOneOfTheValues) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
  EXPECT_EQ(Quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);  // the lower of two in the middle
  EXPECT_EQ(Quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_EQ(Quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_EQ(Quantile({5.0, 4.0, 3.0, 2.0, 1.0}, 0.75), 4.0);
}

TEST(Quantile, DoesNotDependOnTheOrder) {
  std::vector<double> values = SomeValues(50);
  const double before = Quantile(values, 0.3);
  std::ranges::reverse(values);
  EXPECT_EQ(Quantile(values, 0.3), before);
}

}  // namespace
}  // namespace orbweave
