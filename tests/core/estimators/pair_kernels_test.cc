// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/pair_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/base/random.h"

namespace orbweave::internal {
namespace {

constexpr size_t kCount = 77;  // no whole number of vectors

/// Unit bearings by nothing but sums, products, quotients and roots, which are exact everywhere.
std::vector<double> RandomBearings(uint64_t seed) {
  Random random(seed);
  std::vector<double> xyz;
  while (xyz.size() < 3 * kCount) {
    const double x = random.Uniform(-1.0, 1.0);
    const double y = random.Uniform(-1.0, 1.0);
    const double z = random.Uniform(-1.0, 1.0);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length > 0.1) xyz.insert(xyz.end(), {x / length, y / length, z / length});
  }
  return xyz;
}

std::array<std::vector<double>, 3> ColumnsOf(const std::vector<double>& xyz) {
  std::array<std::vector<double>, 3> columns;
  for (size_t i = 0; i < xyz.size(); ++i) columns[i % 3].push_back(xyz[i]);
  return columns;
}

struct Pairs {
  std::vector<double> xyz_a = RandomBearings(1);
  std::vector<double> xyz_b = RandomBearings(2);
  std::array<std::vector<double>, 3> a = ColumnsOf(xyz_a);
  std::array<std::vector<double>, 3> b = ColumnsOf(xyz_b);

  [[nodiscard]] PairColumns Columns() const {
    return {{a[0].data(), a[1].data(), a[2].data()}, {b[0].data(), b[1].data(), b[2].data()}};
  }
};

/// No rotation, a step along z: E = [T]x.
const PoseTerms kPose = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 1}, {1, 0, 0, 0, 1, 0}};
const EpipolarTerms kTerms = {{0, -1, 0, 1, 0, 0, 0, 0, 0}, {0, 0, 1}, {0, 0, 1}};

template <typename Values>
void Append(const Values& values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
}

TEST(PairKernels, GiveTheSameBitsOnEveryProcessor) {
  const Pairs pairs;
  std::string bytes;
  std::vector<double> squared(kCount);
  SquaredSines(kTerms, pairs.Columns(), kCount, squared.data());
  Append(squared, bytes);
  const TruncatedSum sum = SumTruncated(squared.data(), kCount, 0.2);
  Append(std::array{sum.cost}, bytes);
  SquaredChords({1, 0.5, 0, 0.25, 1, 0.125, 0, 0, 2}, pairs.Columns(), kCount, squared.data());
  Append(squared, bytes);
  const ResidualSums sums =
      SumEpipolarResiduals(kPose, pairs.xyz_a.data(), pairs.xyz_b.data(), kCount, 0.1);
  Append(sums.H, bytes);
  Append(sums.g, bytes);
  EXPECT_EQ(DigestOf(bytes).ToShortHex(), "7687f64e4996");
}

TEST(PairKernels, SumWhatIsBelowALimitAndTheLimitOfTheRest) {
  std::vector<double> values = {0.5, 2.0, std::numeric_limits<double>::quiet_NaN()};
  for (size_t count = 3; count < 20; ++count) {
    const TruncatedSum sum = SumTruncated(values.data(), count, 1.0);
    EXPECT_DOUBLE_EQ(sum.cost, 0.5 + 2.0 + 0.25 * static_cast<double>(count - 3)) << count;
    EXPECT_EQ(sum.num_below, count - 2) << count;
    values.push_back(0.25);
  }
}

TEST(PairKernels, CountWithinPlanesWhatIsInFrontOrFar) {
  const Pairs pairs;
  std::vector<double> m[3];
  for (size_t i = 0; i < kCount; ++i) {  // T x q
    m[0].push_back(-pairs.a[1][i]);
    m[1].push_back(pairs.a[0][i]);
    m[2].push_back(0.0);
  }
  const auto [a, b] = pairs.Columns();
  const TurnedColumns turned = {a, {m[0].data(), m[1].data(), m[2].data()}, a[2]};
  const TargetColumns target = {b, b[2]};
  const ErrorLimits limits = {{1.0, 0.3, 0.1, 0.01}, 0.9};
  std::vector<double> squared(kCount);
  SquaredSines(kTerms, pairs.Columns(), kCount, squared.data());
  ErrorCounts expected{};
  for (size_t i = 0; i < kCount; ++i) {
    const double cosine = a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i];
    const bool is_in_front = cosine * b[2][i] - a[2][i] > 0.0 && b[2][i] - cosine * a[2][i] > 0.0;
    if (!is_in_front && cosine <= 0.9) continue;
    for (size_t e = 0; e < kNumErrors; ++e) expected[e] += squared[i] < limits.squared[e] ? 1 : 0;
  }
  EXPECT_GT(expected[3], 0U);
  EXPECT_LT(expected[0], kCount);
  EXPECT_EQ(CountWithinPlanes(turned, target, kCount, limits), expected);
}

}  // namespace
}  // namespace orbweave::internal
