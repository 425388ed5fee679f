// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_similarity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::RandomPoint;
using testing::RandomRotation;
using testing::RotationError;

struct PairedPoints {
  Sim3 b_from_a{};
  std::vector<Vector3d> a{};
  std::vector<Vector3d> b{};
  size_t num_outliers = 0;
};

PairedPoints MakePairs(uint64_t seed,
                       size_t count,
                       double outlier_share = 0.0,
                       double sigma = 0.0) {
  Random random(seed);
  PairedPoints pairs;
  pairs.b_from_a = {
      std::exp(random.Uniform(-2.0, 2.0)), RandomRotation(random), RandomPoint(random, 0.0, 50.0)};
  pairs.num_outliers = static_cast<size_t>(outlier_share * static_cast<double>(count));
  for (size_t i = 0; i < count; ++i) {
    pairs.a.push_back(RandomPoint(random, 0.0, 20.0));
    const Vector3d noise = sigma * Vector3d(random.Normal(), random.Normal(), random.Normal());
    pairs.b.push_back(i < pairs.num_outliers ? RandomPoint(random, 0.0, 60.0)
                                             : pairs.b_from_a * pairs.a[i] + noise);
  }
  return pairs;
}

void ExpectNear(const Sim3& found, const Sim3& truth, double tolerance) {
  EXPECT_NEAR(found.scale / truth.scale, 1.0, tolerance);
  EXPECT_LT(RotationError(found.rotation, truth.rotation), tolerance);
  EXPECT_LT((found.translation - truth.translation).norm(), 100.0 * tolerance);
}

TEST(FitSimilarity, IsExactOnCleanPairs) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const PairedPoints pairs = MakePairs(seed, 3 + seed);
    const auto found = FitSimilarity(pairs.a, pairs.b, {});
    ASSERT_TRUE(found.has_value());
    ExpectNear(*found, pairs.b_from_a, 1e-7);
  }
}

TEST(FitSimilarity, NeverReflects) {
  PairedPoints pairs = MakePairs(1, 10);
  for (size_t i = 0; i < pairs.a.size(); ++i)
    pairs.b[i] = Vector3d(pairs.a[i].x(), pairs.a[i].y(), -pairs.a[i].z());
  const auto found = FitSimilarity(pairs.a, pairs.b, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->rotation.toRotationMatrix().determinant(), 1.0, 1e-9);
}

TEST(FitSimilarity, WeightsCountLikeRepeatedPairs) {
  PairedPoints pairs = MakePairs(2, 6, 0.0, 0.3);
  const std::vector<double> weights = {1, 1, 3, 1, 0, 1};
  const auto weighted = FitSimilarity(pairs.a, pairs.b, weights);
  pairs.a[4] = pairs.a[2];
  pairs.b[4] = pairs.b[2];
  pairs.a.push_back(pairs.a[2]);
  pairs.b.push_back(pairs.b[2]);
  const auto repeated = FitSimilarity(pairs.a, pairs.b, {});
  ASSERT_TRUE(weighted && repeated);
  ExpectNear(*weighted, *repeated, 1e-10);
}

TEST(FitSimilarity, RefusesTooFewEqualAndCollinearPoints) {
  const PairedPoints two = MakePairs(3, 2);
  EXPECT_FALSE(FitSimilarity(two.a, two.b, {}).has_value());
  PairedPoints pairs = MakePairs(3, 8);
  for (size_t i = 0; i < pairs.a.size(); ++i) {
    pairs.a[i] = Vector3d(4e5, 5e6, 30) + static_cast<double>(i) * Vector3d(1, 2, 3);
    pairs.b[i] = pairs.b_from_a * pairs.a[i];
  }
  EXPECT_FALSE(FitSimilarity(pairs.a, pairs.b, {}).has_value());
  pairs.a.assign(8, Vector3d(1, 2, 3));
  EXPECT_FALSE(FitSimilarity(pairs.a, pairs.b, {}).has_value());
}

TEST(FitSimilarity, AcceptsALongNarrowStreet) {
  PairedPoints pairs = MakePairs(4, 50);
  for (size_t i = 0; i < pairs.a.size(); ++i) {
    pairs.a[i] =
        Vector3d(20.0 * static_cast<double>(i), 0.5 * pairs.a[i].y(), 0.1 * pairs.a[i].z());
    pairs.b[i] = pairs.b_from_a * pairs.a[i];
  }
  const auto found = FitSimilarity(pairs.a, pairs.b, {});
  ASSERT_TRUE(found.has_value());
  ExpectNear(*found, pairs.b_from_a, 1e-7);
}

TEST(EstimateSimilarity, IsRightForEverySeedAndShareOfOutliers) {
  for (const double outlier_share : {0.3, 0.5, 0.7}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const PairedPoints pairs = MakePairs(seed, 100, outlier_share, 0.02);
      const auto found = EstimateSimilarity(pairs.a, pairs.b, 0.1, {.seed = seed});
      ASSERT_TRUE(found.ok() && found->has_value());
      ExpectNear((*found)->b_from_a, pairs.b_from_a, 2e-2);
      EXPECT_GE((*found)->num_inliers, 100 - pairs.num_outliers - 1);
      EXPECT_LE((*found)->num_inliers, 100 - pairs.num_outliers + 1);
    }
  }
}

TEST(EstimateSimilarity, HasNoAnswerForFewOrCollinearPairs) {
  PairedPoints pairs = MakePairs(1, 2);
  EXPECT_FALSE((*EstimateSimilarity(pairs.a, pairs.b, 0.1, {})).has_value());
  pairs.a = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  pairs.b = pairs.a;
  EXPECT_FALSE((*EstimateSimilarity(pairs.a, pairs.b, 0.1, {})).has_value());
  EXPECT_FALSE((*EstimateSimilarity({}, {}, 0.1, {})).has_value());
}

TEST(EstimateSimilarity, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const PairedPoints pairs = MakePairs(1, 20);
  const auto found = EstimateSimilarity(pairs.a, pairs.b, 0.1, {.stop = source.get_token()});
  EXPECT_EQ(found.status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
