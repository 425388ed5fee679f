// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_absolute_pose.h"

#include <array>

#include "core/base/status.h"
#include "core/estimators/bearing_points.h"
#include "core/estimators/refine_absolute_pose.h"
#include "core/geometry/p3p.h"
#include "core/robust/ransac.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kLocalSteps = 4;   // Levenberg-Marquardt inside RANSAC
constexpr int kFinalRefits = 3;  // alternations of inliers and pose after it

class AbsolutePoseEstimator {
 public:
  static constexpr size_t kSampleSize = 3;
  using Model = Rigid3;

  AbsolutePoseEstimator(const BearingPoints& data, double max_error_rad)
      : data_(data), max_error_rad_(max_error_rad) {}

  [[nodiscard]] size_t Size() const { return data_.Size(); }

  void Generate(std::span<const uint32_t> sample, std::vector<Rigid3>& models) const {
    std::array<Vector3d, 3> bearings;
    std::array<Vector3d, 3> points;
    for (size_t k = 0; k < 3; ++k) {
      bearings[k] = data_.Bearing(sample[k]);
      points[k] = data_.Point(sample[k]);
    }
    for (const Rigid3& pose : SolveP3p(bearings, points)) models.push_back(pose);
  }

  [[nodiscard]] std::optional<RansacScore> Score(const Rigid3& pose,
                                                 const EarlyRejection& gate) const {
    return ScorePose(data_, pose, max_error_rad_, gate);
  }

  [[nodiscard]] Rigid3 Refine(const Rigid3& pose) const {
    return RefineOnInliers(pose, kLocalSteps);
  }

  [[nodiscard]] Rigid3 RefineOnInliers(const Rigid3& pose, int max_steps) const {
    std::vector<Vector3d> bearings;
    std::vector<Vector3d> points;
    for (const uint32_t i : PoseInliers(data_, pose, max_error_rad_)) {
      bearings.push_back(data_.Bearing(i));
      points.push_back(data_.Point(i));
    }
    return MinimiseTangentResiduals(pose, bearings, points, 0.5 * max_error_rad_, max_steps);
  }

 private:
  const BearingPoints& data_;
  double max_error_rad_;
};

/// The best of RANSAC refined to convergence, with new inliers, while its score improves.
Rigid3 RefineToConvergence(const AbsolutePoseEstimator& estimator, Rigid3 pose) {
  const EarlyRejection open_gate(estimator.Size());
  double cost = estimator.Score(pose, open_gate)->cost;
  for (int refit = 0; refit < kFinalRefits; ++refit) {
    const Rigid3 candidate = estimator.RefineOnInliers(pose, kMaxRefinementSteps);
    const double candidate_cost = estimator.Score(candidate, open_gate)->cost;
    if (!(candidate_cost < cost)) break;
    pose = candidate;
    cost = candidate_cost;
  }
  return pose;
}

/// Back to the caller's order and origin.
AbsolutePose MakeResult(const BearingPoints& data, const Rigid3& pose, double max_error_rad) {
  AbsolutePose result;
  result.cam_from_world = {pose.rotation, pose.translation - pose.rotation * data.origin};
  result.is_inlier.resize(data.Size(), 0);
  for (const uint32_t i : PoseInliers(data, pose, max_error_rad)) {
    result.is_inlier[data.order[i]] = 1;
    ++result.num_inliers;
  }
  return result;
}

}  // namespace

absl::StatusOr<std::optional<AbsolutePose>> EstimateAbsolutePose(
    std::span<const Vector3d> bearings,
    std::span<const Vector3d> points_in_world,
    double max_error_rad,
    const AbsolutePoseOptions& options,
    const StageContext& context) {
  ORBWEAVE_CHECK(bearings.size() == points_in_world.size());
  const BearingPoints data = ArrangePoints(bearings, points_in_world, context.seed);
  const AbsolutePoseEstimator estimator(data, max_error_rad);
  const RansacOptions ransac = {.confidence = options.confidence, .max_trials = options.max_trials};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best, Ransac(estimator, ransac, context));
  if (!best.model) return std::nullopt;
  const Rigid3 pose = RefineToConvergence(estimator, *best.model);
  AbsolutePose result = MakeResult(data, pose, max_error_rad);
  if (result.num_inliers < static_cast<uint32_t>(options.min_inliers)) return std::nullopt;
  return result;
}

Rigid3 RefineAbsolutePose(const Rigid3& initial,
                          std::span<const Vector3d> bearings,
                          std::span<const Vector3d> points_in_world,
                          std::span<const uint8_t> is_inlier,
                          double max_error_rad) {
  ORBWEAVE_CHECK(bearings.size() == points_in_world.size());
  ORBWEAVE_CHECK(is_inlier.empty() || is_inlier.size() == bearings.size());
  if (is_inlier.empty()) {
    return MinimiseTangentResiduals(
        initial, bearings, points_in_world, 0.5 * max_error_rad, kMaxRefinementSteps);
  }
  std::vector<Vector3d> used_bearings;
  std::vector<Vector3d> used_points;
  for (size_t i = 0; i < is_inlier.size(); ++i) {
    if (is_inlier[i] == 0) continue;
    used_bearings.push_back(bearings[i]);
    used_points.push_back(points_in_world[i]);
  }
  return MinimiseTangentResiduals(
      initial, used_bearings, used_points, 0.5 * max_error_rad, kMaxRefinementSteps);
}

}  // namespace orbweave
