// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/explain_by_ray_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/ray_maps.h"
#include "core/robust/ransac.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kConfidence = 0.9999;
constexpr int kTrialsFactor = 4;  // minimal samples are noisy: more than a clean sample's worth
constexpr int kMaxRefits = 3;

/// RANSAC over maps M of bearings, fitted by `fit(bearings_a, bearings_b)`; residual: the chord
/// between p_b and M p_a / |M p_a|.
template <size_t kSize, typename Fit>
class RayMapEstimator {
 public:
  static constexpr size_t kSampleSize = kSize;
  using Model = Matrix3d;

  RayMapEstimator(const BearingPairs& pairs, double max_error_rad, const Fit& fit)
      : pairs_(pairs), fit_(fit), max_squared_chord_(2.0 - 2.0 * std::cos(max_error_rad)) {}

  [[nodiscard]] size_t Size() const { return pairs_.Size(); }

  void Generate(std::span<const uint32_t> sample, std::vector<Matrix3d>& models) const {
    std::array<Vector3d, kSize> a;
    std::array<Vector3d, kSize> b;
    for (size_t k = 0; k < kSize; ++k) {
      a[k] = pairs_.A(sample[k]);
      b[k] = pairs_.B(sample[k]);
    }
    if (const std::optional<Matrix3d> M = fit_(a, b)) models.push_back(*M);
  }

  [[nodiscard]] std::optional<RansacScore> Score(const Matrix3d& M,
                                                 const EarlyRejection& gate) const {
    std::array<double, EarlyRejection::kBlock> squared;
    RansacScore score;
    for (size_t begin = 0; begin < Size(); begin += squared.size()) {
      const size_t end = std::min(begin + squared.size(), Size());
      SquaredChords(M, begin, end, squared.data());
      const internal::TruncatedSum sum =
          internal::SumTruncated(squared.data(), end - begin, max_squared_chord_);
      score.cost += sum.cost;
      score.num_inliers += sum.num_below;
      if (gate.Rejects(score.cost, score.num_inliers, end)) return std::nullopt;
    }
    return score;
  }

  [[nodiscard]] Matrix3d Refine(Matrix3d M) const {
    for (int refit = 0; refit < kMaxRefits; ++refit) {
      const SelectedBearings selected = SelectPairs(pairs_, Inliers(M));
      const std::optional<Matrix3d> fitted = fit_(selected.a, selected.b);
      if (!fitted) break;
      M = *fitted;
    }
    return M;
  }

  [[nodiscard]] std::vector<uint32_t> Inliers(const Matrix3d& M) const {
    std::vector<double> squared(Size());
    SquaredChords(M, 0, Size(), squared.data());
    std::vector<uint32_t> inliers;
    for (uint32_t i = 0; i < Size(); ++i) {
      if (squared[i] < max_squared_chord_) inliers.push_back(i);
    }
    return inliers;
  }

 private:
  void SquaredChords(const Matrix3d& M, size_t begin, size_t end, double* squared) const {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_rows = M;
    std::array<double, 9> entries;
    std::copy_n(by_rows.data(), entries.size(), entries.begin());
    internal::SquaredChords(entries, pairs_.ColumnsFrom(begin), end - begin, squared);
  }

  const BearingPairs& pairs_;
  const Fit& fit_;
  double max_squared_chord_;
};

template <size_t kSize, typename Fit>
absl::StatusOr<RayMap> Explain(const BearingPairs& pairs,
                               const Fit& fit,
                               double max_error_rad,
                               double min_share,
                               const StageContext& context) {
  const RayMapEstimator<kSize, Fit> estimator(pairs, max_error_rad, fit);
  constexpr int kUnlimited = 1000;
  const RansacOptions options = {
      .confidence = kConfidence,
      .max_trials = kTrialsFactor * RequiredTrials(min_share, kSize, kConfidence, kUnlimited),
      .min_inlier_share = min_share};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best, Ransac(estimator, options, context));
  if (!best.model) return RayMap{};
  return RayMap{.M = *best.model, .inliers = estimator.Inliers(*best.model)};
}

}  // namespace

absl::StatusOr<RayMap> ExplainByRotation(const BearingPairs& pairs,
                                         double max_error_rad,
                                         double min_share,
                                         const StageContext& context) {
  return Explain<2>(pairs, FitRayRotation, max_error_rad, min_share, context);
}

absl::StatusOr<RayMap> ExplainByHomography(const BearingPairs& pairs,
                                           double max_error_rad,
                                           double min_share,
                                           const StageContext& context) {
  return Explain<4>(pairs, FitRayHomography, max_error_rad, min_share, context);
}

absl::StatusOr<RayMap> ExplainByPlane(const BearingPairs& pairs,
                                      const Rigid3& b_from_a,
                                      double max_error_rad,
                                      double min_share,
                                      const StageContext& context) {
  const auto fit = [&](std::span<const Vector3d> a, std::span<const Vector3d> b) {
    return FitRayPlane(b_from_a, a, b);
  };
  return Explain<3>(pairs, fit, max_error_rad, min_share, context);
}

}  // namespace orbweave
