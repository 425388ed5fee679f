// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/two_view_ransac.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/estimators/match_evidence.h"
#include "core/estimators/refine_two_view.h"
#include "core/estimators/resolve_cheirality.h"
#include "core/geometry/eight_point.h"
#include "core/geometry/essential.h"
#include "core/geometry/five_point.h"
#include "core/geometry/turned_two_point.h"
#include "core/geometry/upright_three_point.h"
#include "core/robust/ransac.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kLocalSteps = 4;
constexpr int kMinTrials = 30;  // nearly planar scenes have two good models: both should be seen

struct FivePointSolver {
  static constexpr size_t kSampleSize = 5;
  static constexpr size_t kEvidence = kPoseSample;
  static void Solve(std::span<const Vector3d, 5> a,
                    std::span<const Vector3d, 5> b,
                    std::vector<Rigid3>& poses) {
    for (const Eigen::Matrix3d& E : SolveFivePoint(a, b)) poses.push_back(PosesFromEssential(E)[0]);
  }
};

struct EightPointSolver {
  static constexpr size_t kSampleSize = 8;
  static constexpr size_t kEvidence = kPoseSample;
  static void Solve(std::span<const Vector3d, 8> a,
                    std::span<const Vector3d, 8> b,
                    std::vector<Rigid3>& poses) {
    if (const auto E = SolveEightPoint(a, b)) poses.push_back(PosesFromEssential(*E)[0]);
  }
};

struct UprightThreePointSolver {
  static constexpr size_t kSampleSize = 3;
  static constexpr size_t kEvidence = kPoseSample;
  static void Solve(std::span<const Vector3d, 3> a,
                    std::span<const Vector3d, 3> b,
                    std::vector<Rigid3>& poses) {
    for (const Rigid3& pose : SolveUprightThreePoint(a, b)) poses.push_back(pose);
  }
};

/// Baselines that lead where they are not predicted are none.
struct TurnedTwoPointSolver {
  static constexpr size_t kSampleSize = 2;
  static constexpr size_t kEvidence = kTurnedSample;
  const PredictedPose& predicted;

  void Solve(std::span<const Vector3d, 2> a,
             std::span<const Vector3d, 2> b,
             std::vector<Rigid3>& poses) const {
    const std::optional<Rigid3> pose = SolveTurnedTwoPoint(predicted.rotation, a, b);
    if (pose && predicted.AgreesWith(*pose)) poses.push_back(*pose);
  }
};

template <typename Solver>
class TwoViewEstimator {
 public:
  static constexpr size_t kSampleSize = Solver::kSampleSize;
  using Model = Rigid3;

  TwoViewEstimator(const Solver& solver,
                   const BearingPairs& pairs,
                   MatchOrder order,
                   double max_error_rad)
      : solver_(solver), pairs_(pairs), max_error_rad_(max_error_rad) {
    if (order == MatchOrder::kUnknown) return;
    best_first_.resize(pairs.Size());
    for (uint32_t i = 0; i < pairs.Size(); ++i) best_first_[pairs.order[i]] = i;
  }

  [[nodiscard]] size_t Size() const { return pairs_.Size(); }

  [[nodiscard]] std::span<const uint32_t> BestFirst() const { return best_first_; }

  void Generate(std::span<const uint32_t> sample, std::vector<Rigid3>& models) const {
    std::array<Vector3d, kSampleSize> a;
    std::array<Vector3d, kSampleSize> b;
    for (size_t k = 0; k < kSampleSize; ++k) {
      a[k] = pairs_.A(sample[k]);
      b[k] = pairs_.B(sample[k]);
    }
    solver_.Solve(a, b, models);
  }

  /// Inliers on the wrong side count as outliers, for the best of the four poses. This is looked at
  /// in the few models that reach the end, and tells the two poses apart that fit a plane.
  [[nodiscard]] std::optional<RansacScore> Score(const Rigid3& pose,
                                                 const EarlyRejection& gate) const {
    std::optional<RansacScore> score = ScoreEpipolar(pairs_, pose, max_error_rad_, gate);
    if (!score) return std::nullopt;
    const auto num_in_front =
        static_cast<uint32_t>(ResolveCheirality(pairs_, pose, max_error_rad_).inliers.size());
    const double max_squared = std::sin(max_error_rad_) * std::sin(max_error_rad_);
    score->cost += (score->num_inliers - num_in_front) * max_squared;
    score->num_inliers = num_in_front;
    return score;
  }

  [[nodiscard]] Rigid3 Refine(const Rigid3& pose) const {
    const SelectedBearings inliers =
        SelectPairs(pairs_, EpipolarInliers(pairs_, pose, max_error_rad_));
    return MinimiseEpipolarResiduals(pose, inliers.a, inliers.b, 0.5 * max_error_rad_, kLocalSteps);
  }

 private:
  const Solver& solver_;
  const BearingPairs& pairs_;
  std::vector<uint32_t> best_first_{};
  double max_error_rad_;
};

template <typename Solver>
absl::StatusOr<std::optional<Rigid3>> Find(const Solver& solver,
                                           const BearingPairs& pairs,
                                           MatchOrder order,
                                           double max_error_rad,
                                           const TwoViewOptions& options,
                                           const StageContext& context) {
  const TwoViewEstimator<Solver> estimator(solver, pairs, order, max_error_rad);
  const double telling_share =
      std::max(options.min_inlier_share,
               SmallestTellingShare(
                   pairs.Size(), max_error_rad, options.max_log10_false_alarms, Solver::kEvidence));
  const RansacOptions ransac = {
      .confidence = options.confidence,
      .min_trials = kMinTrials,
      .max_trials =
          std::max(kMinTrials,
                   RequiredTrials(
                       telling_share, Solver::kSampleSize, options.confidence, options.max_trials)),
      .min_inlier_share = telling_share};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best, Ransac(estimator, ransac, context));
  return best.model;
}

}  // namespace

absl::StatusOr<std::optional<Rigid3>> FindRelativePose(const BearingPairs& pairs,
                                                       const TwoViewHints& hints,
                                                       double max_error_rad,
                                                       const TwoViewOptions& options,
                                                       const StageContext& context) {
  const auto find = [&](const auto& solver) {
    return Find(solver, pairs, hints.order, max_error_rad, options, context);
  };
  if (hints.predicted) return find(TurnedTwoPointSolver{*hints.predicted});
  switch (options.solver) {
    case TwoViewSolver::kEightPoint:
      return find(EightPointSolver{});
    case TwoViewSolver::kUprightThreePoint:
      return find(UprightThreePointSolver{});
    case TwoViewSolver::kFivePoint:
      break;
  }
  return find(FivePointSolver{});
}

}  // namespace orbweave
