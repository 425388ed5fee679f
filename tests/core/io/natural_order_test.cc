// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace orbweave {
namespace {

TEST(NaturalLess, OrdersNumbersByValue) {
  std::vector<std::string> names = {
      "img10.jpg", "img2.jpg", "img1.jpg", "b/1", "a/20", "a/3", "a1/2", "img002.jpg"};
  std::sort(names.begin(), names.end(), NaturalLess);
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "a/3", "a/20", "a1/2", "b/1", "img1.jpg", "img2.jpg", "img002.jpg", "img10.jpg"}));
}

TEST(NaturalLess, ComparesNumbersOfAnyLength) {
  EXPECT_TRUE(NaturalLess("x99999999999999999999998", "x99999999999999999999999"));
  EXPECT_TRUE(NaturalLess("x9", "x100000000000000000000000"));
}

TEST(NaturalLess, IsAStrictTotalOrder) {
  const std::vector<std::string> names = {"",
                                          "0",
                                          "00",
                                          "a",
                                          "a0",
                                          "a00",
                                          "a0b",
                                          "a00b",
                                          "a01",
                                          "a1",
                                          "a/1",
                                          "a-1",
                                          "1a",
                                          "01a",
                                          "1",
                                          "01"};
  for (const std::string& x : names) {
    for (const std::string& y : names) {
      EXPECT_EQ(NaturalLess(x, y) + NaturalLess(y, x), x == y ? 0 : 1) << x << " " << y;
      for (const std::string& z : names) {
        EXPECT_TRUE(!NaturalLess(x, y) || !NaturalLess(y, z) || NaturalLess(x, z))
            << x << " " << y << " " << z;
      }
    }
  }
}

}  // namespace
}  // namespace orbweave
