// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/real_roots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Coefficients of prod (x - root) times prod (x^2 + c^2).
std::vector<double> FromRoots(const std::vector<double>& roots,
                              const std::vector<double>& imaginary = {}) {
  std::vector<double> c = {1.0};
  const auto multiply = [&c](const std::vector<double>& factor) {
    std::vector<double> product(c.size() + factor.size() - 1, 0.0);
    for (size_t i = 0; i < c.size(); ++i) {
      for (size_t j = 0; j < factor.size(); ++j) product[i + j] += c[i] * factor[j];
    }
    c = product;
  };
  for (const double root : roots) multiply({-root, 1.0});
  for (const double value : imaginary) multiply({value * value, 0.0, 1.0});
  return c;
}

TEST(RealRoots, FindsAllRootsOfRandomPolynomials) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> roots(1 + random.Index(6));
    for (double& root : roots) root = random.Uniform(-3.0, 3.0);
    std::sort(roots.begin(), roots.end());
    const auto close = std::adjacent_find(
        roots.begin(), roots.end(), [](double a, double b) { return b - a < 0.05; });
    if (close != roots.end()) continue;
    const auto found = RealRoots(FromRoots(roots, {0.7, 1.9}));
    ASSERT_EQ(found.size(), roots.size()) << trial;
    for (size_t i = 0; i < roots.size(); ++i) EXPECT_NEAR(found[i], roots[i], 1e-6) << trial;
  }
}

TEST(RealRoots, FindsRootsOfVeryDifferentSize) {
  EXPECT_THAT(RealRoots(FromRoots({-1e4, 1e-4, 2.0, 1e4})),
              ElementsAre(DoubleNear(-1e4, 1e-4),
                          DoubleNear(1e-4, 1e-9),
                          DoubleNear(2, 1e-9),
                          DoubleNear(1e4, 1e-4)));
}

TEST(RealRoots, FindsZeroAndDoubleRootsOnce) {
  EXPECT_THAT(RealRoots(std::vector<double>{0.0, 0.0, 1.0}), ElementsAre(DoubleNear(0.0, 1e-9)));
  EXPECT_THAT(RealRoots(std::vector<double>{0.0, -1.0, 0.0, 1.0}),
              ElementsAre(DoubleNear(-1, 1e-12), DoubleNear(0, 1e-12), DoubleNear(1, 1e-12)));
  EXPECT_THAT(RealRoots(std::vector<double>{1.0, -2.0, 1.0}), ElementsAre(DoubleNear(1.0, 1e-6)));
}

TEST(RealRoots, IgnoresLeadingZeros) {
  EXPECT_THAT(RealRoots(std::vector<double>{-2.0, 1.0, 0.0, 0.0}),
              ElementsAre(DoubleNear(2.0, 1e-12)));
}

TEST(RealRoots, HasNoneForConstantsAndComplexPairs) {
  EXPECT_THAT(RealRoots(std::vector<double>{}), IsEmpty());
  EXPECT_THAT(RealRoots(std::vector<double>{0.0, 0.0}), IsEmpty());
  EXPECT_THAT(RealRoots(std::vector<double>{3.0}), IsEmpty());
  EXPECT_THAT(RealRoots(std::vector<double>{1.0, 0.0, 1.0}), IsEmpty());
}

}  // namespace
}  // namespace orbweave
