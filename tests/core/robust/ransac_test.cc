// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/robust/ransac.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

/// y = slope x + offset through points with outliers.
struct Line {
  double slope = 0.0;
  double offset = 0.0;
};

class LineEstimator {
 public:
  static constexpr size_t kSampleSize = 2;
  using Model = Line;

  LineEstimator(uint64_t seed, size_t count, double outlier_share) {
    Random random(seed);
    for (size_t i = 0; i < count; ++i) {
      x_.push_back(random.Uniform(-1.0, 1.0));
      const bool outlier = random.Uniform() < outlier_share;
      y_.push_back(outlier ? random.Uniform(-5.0, 5.0)
                           : 2.0 * x_[i] + 1.0 + 0.01 * random.Normal());
    }
  }

  [[nodiscard]] size_t Size() const { return x_.size(); }

  void Generate(std::span<const uint32_t> sample, std::vector<Line>& models) const {
    const double slope = (y_[sample[1]] - y_[sample[0]]) / (x_[sample[1]] - x_[sample[0]]);
    models.push_back({slope, y_[sample[0]] - slope * x_[sample[0]]});
  }

  [[nodiscard]] std::optional<RansacScore> Score(const Line& line,
                                                 const EarlyRejection& gate) const {
    RansacScore score;
    for (size_t i = 0; i < Size(); ++i) {
      const double squared = std::pow(y_[i] - line.slope * x_[i] - line.offset, 2);
      score.cost += std::min(squared, kMaxSquared);
      score.num_inliers += squared < kMaxSquared ? 1U : 0U;
    }
    if (gate.Rejects(score.cost, score.num_inliers, Size())) return std::nullopt;
    return score;
  }

  /// Least squares on the inliers.
  [[nodiscard]] Line Refine(const Line& line) const {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < Size(); ++i) {
      if (std::pow(y_[i] - line.slope * x_[i] - line.offset, 2) >= kMaxSquared) continue;
      n += 1.0;
      sx += x_[i];
      sy += y_[i];
      sxx += x_[i] * x_[i];
      sxy += x_[i] * y_[i];
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {slope, (sy - slope * sx) / n};
  }

 private:
  static constexpr double kMaxSquared = 0.04 * 0.04;
  std::vector<double> x_;
  std::vector<double> y_;
};

TEST(Ransac, FindsTheLineAmongOutliers) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const LineEstimator estimator(seed, 300, 0.7);
    const auto result = Ransac(estimator, {}, {.seed = seed});
    ASSERT_TRUE(result.ok() && result->model.has_value());
    EXPECT_NEAR(result->model->slope, 2.0, 0.02) << seed;
    EXPECT_NEAR(result->model->offset, 1.0, 0.02) << seed;
    EXPECT_NEAR(result->score.num_inliers, 92, 20) << seed;
  }
}

TEST(Ransac, DrawsNoMoreTrialsThanTheShareOfInliersAsksFor) {
  const auto clean = Ransac(LineEstimator(1, 300, 0.0), {}, {.seed = 1});
  const auto dirty = Ransac(LineEstimator(1, 300, 0.7), {}, {.seed = 1});
  ASSERT_TRUE(clean.ok() && dirty.ok());
  EXPECT_LT(clean->report.num_trials, 10);
  EXPECT_GT(dirty->report.num_trials, 50);
  EXPECT_LT(dirty->report.num_trials, 400);
  EXPECT_LT(dirty->report.num_refinements, 20);
}

TEST(Ransac, KeepsToTheBoundsOnTrials) {
  const LineEstimator clean(1, 300, 0.0);
  EXPECT_EQ(Ransac(clean, {.min_trials = 50}, {})->report.num_trials, 50);
  EXPECT_EQ(Ransac(LineEstimator(1, 300, 0.95), {.max_trials = 20}, {})->report.num_trials, 20);
  EXPECT_EQ(Ransac(clean, {.min_trials = 50, .max_trials = 20}, {})->report.num_trials, 20);
}

TEST(Ransac, DependsOnTheSeedAlone) {
  const LineEstimator estimator(3, 300, 0.5);
  const auto once = Ransac(estimator, {}, {.seed = 5});
  const auto again = Ransac(estimator, {}, {.seed = 5});
  ASSERT_TRUE(once.ok() && again.ok());
  EXPECT_EQ(once->model->slope, again->model->slope);
  EXPECT_EQ(once->report.num_trials, again->report.num_trials);
}

TEST(Ransac, HasNoModelForLessThanASample) {
  const auto result = Ransac(LineEstimator(1, 1, 0.0), {}, {});
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result->model.has_value());
  EXPECT_EQ(result->report.num_trials, 0);
}

TEST(Ransac, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const auto result = Ransac(LineEstimator(1, 100, 0.0), {}, {.stop = source.get_token()});
  EXPECT_EQ(result.status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
