// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_similarity.h"

#include <array>

#include "core/base/status.h"
#include "core/robust/ransac.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr RansacOptions kRansac = {.confidence = 0.9999, .max_trials = 10000};
constexpr int kMaxRefits = 3;

/// Point pairs in random order.
struct PointPairs {
  std::vector<uint32_t> order;
  std::vector<Vector3d> a;
  std::vector<Vector3d> b;
};

PointPairs Arrange(std::span<const Vector3d> a, std::span<const Vector3d> b, uint64_t seed) {
  PointPairs pairs{.order = ShuffledOrder(static_cast<uint32_t>(a.size()), seed), .a = {}, .b = {}};
  for (const uint32_t i : pairs.order) {
    pairs.a.push_back(a[i]);
    pairs.b.push_back(b[i]);
  }
  return pairs;
}

class SimilarityEstimator {
 public:
  static constexpr size_t kSampleSize = 3;
  using Model = Sim3;

  SimilarityEstimator(const PointPairs& pairs, double max_error)
      : pairs_(pairs), max_squared_error_(max_error * max_error) {}

  [[nodiscard]] size_t Size() const { return pairs_.order.size(); }

  void Generate(std::span<const uint32_t> sample, std::vector<Sim3>& models) const {
    if (const std::optional<Sim3> model = Fit(sample)) models.push_back(*model);
  }

  [[nodiscard]] std::optional<RansacScore> Score(const Sim3& model,
                                                 const EarlyRejection& gate) const {
    RansacScore score;
    for (size_t begin = 0; begin < Size(); begin += EarlyRejection::kBlock) {
      const size_t end = std::min(begin + EarlyRejection::kBlock, Size());
      for (size_t i = begin; i < end; ++i) {
        const double squared = SquaredError(model, i);
        const bool inlier = squared < max_squared_error_;
        score.cost += inlier ? squared : max_squared_error_;
        score.num_inliers += inlier ? 1U : 0U;
      }
      if (gate.Rejects(score.cost, score.num_inliers, end)) return std::nullopt;
    }
    return score;
  }

  [[nodiscard]] Sim3 Refine(Sim3 model) const {
    for (int refit = 0; refit < kMaxRefits; ++refit) {
      const std::optional<Sim3> fitted = Fit(Inliers(model));
      if (!fitted) break;
      model = *fitted;
    }
    return model;
  }

  [[nodiscard]] std::vector<uint32_t> Inliers(const Sim3& model) const {
    std::vector<uint32_t> inliers;
    for (uint32_t i = 0; i < Size(); ++i) {
      if (SquaredError(model, i) < max_squared_error_) inliers.push_back(i);
    }
    return inliers;
  }

 private:
  [[nodiscard]] double SquaredError(const Sim3& model, size_t i) const {
    return (pairs_.b[i] - model * pairs_.a[i]).squaredNorm();
  }

  [[nodiscard]] std::optional<Sim3> Fit(std::span<const uint32_t> indices) const {
    std::vector<Vector3d> a;
    std::vector<Vector3d> b;
    for (const uint32_t i : indices) {
      a.push_back(pairs_.a[i]);
      b.push_back(pairs_.b[i]);
    }
    return FitSimilarity(a, b, {});
  }

  const PointPairs& pairs_;
  double max_squared_error_;
};

}  // namespace

absl::StatusOr<std::optional<RobustSimilarity>> EstimateSimilarity(
    std::span<const Vector3d> points_in_a,
    std::span<const Vector3d> points_in_b,
    double max_error,
    const StageContext& context) {
  ORBWEAVE_CHECK(points_in_a.size() == points_in_b.size());
  const PointPairs pairs = Arrange(points_in_a, points_in_b, context.seed);
  const SimilarityEstimator estimator(pairs, max_error);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best, Ransac(estimator, kRansac, context));
  if (!best.model || best.score.num_inliers < 3) return std::nullopt;
  RobustSimilarity result{.b_from_a = *best.model};
  result.is_inlier.resize(pairs.order.size(), 0);
  for (const uint32_t i : estimator.Inliers(*best.model)) {
    result.is_inlier[pairs.order[i]] = 1;
    ++result.num_inliers;
  }
  return result;
}

}  // namespace orbweave
