// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/estimate_absolute_pose.h"

#include <array>
#include <cmath>

#include "core/base/status.h"
#include "core/estimators/refine_absolute_pose.h"
#include "core/geometry/p3p.h"
#include "core/robust/ransac.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kLocalSteps = 4;   // Levenberg-Marquardt inside RANSAC
constexpr int kFinalRefits = 3;  // alternations of inliers and pose after it

/// Correspondences in random order, one array per coordinate. Points are relative to `origin`, one of
/// them: far from the world's origin no digits are lost.
struct Correspondences {
  std::vector<uint32_t> order;
  Vector3d origin = Vector3d::Zero();
  std::array<std::vector<double>, 3> b;
  std::array<std::vector<double>, 3> P;

  [[nodiscard]] size_t Size() const { return order.size(); }
  [[nodiscard]] Vector3d Bearing(size_t i) const { return {b[0][i], b[1][i], b[2][i]}; }
  [[nodiscard]] Vector3d Point(size_t i) const { return {P[0][i], P[1][i], P[2][i]}; }
};

Correspondences Arrange(std::span<const Vector3d> bearings, std::span<const Vector3d> points, uint64_t seed) {
  Correspondences data;
  data.order = ShuffledOrder(static_cast<uint32_t>(bearings.size()), seed);
  if (!points.empty()) data.origin = points[0];
  for (int k = 0; k < 3; ++k) {
    data.b[k].reserve(data.Size());
    data.P[k].reserve(data.Size());
    for (const uint32_t i : data.order) {
      data.b[k].push_back(bearings[i][k]);
      data.P[k].push_back(points[i][k] - data.origin[k]);
    }
  }
  return data;
}

/// Squared chords |b - u|^2 = 2 (1 - cos e) between bearings and directions u of the points seen from
/// `pose`, for the data [begin, end): equation (10) without the acos, and no antipodes.
void SquaredChords(const Correspondences& data, const Rigid3& pose, size_t begin, size_t end, double* chords) {
  const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
  const Vector3d& t = pose.translation;
  const double* const X = data.P[0].data() + begin;
  const double* const Y = data.P[1].data() + begin;
  const double* const Z = data.P[2].data() + begin;
  const double* const bx = data.b[0].data() + begin;
  const double* const by = data.b[1].data() + begin;
  const double* const bz = data.b[2].data() + begin;
  for (size_t i = 0; i < end - begin; ++i) {
    const double x = R(0, 0) * X[i] + R(0, 1) * Y[i] + R(0, 2) * Z[i] + t.x();
    const double y = R(1, 0) * X[i] + R(1, 1) * Y[i] + R(1, 2) * Z[i] + t.y();
    const double z = R(2, 0) * X[i] + R(2, 1) * Y[i] + R(2, 2) * Z[i] + t.z();
    const double along = bx[i] * x + by[i] * y + bz[i] * z;
    chords[i] = 2.0 - 2.0 * along / std::sqrt(x * x + y * y + z * z);
  }
}

class AbsolutePoseEstimator {
 public:
  static constexpr size_t kSampleSize = 3;
  using Model = Rigid3;

  AbsolutePoseEstimator(const Correspondences& data, double max_error_rad)
      : data_(data), max_error_rad_(max_error_rad), max_squared_chord_(2.0 - 2.0 * std::cos(max_error_rad)) {}

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

  [[nodiscard]] std::optional<RansacScore> Score(const Rigid3& pose, const EarlyRejection& gate) const {
    std::array<double, EarlyRejection::kBlock> chords;
    RansacScore score;
    for (size_t begin = 0; begin < Size(); begin += chords.size()) {
      const size_t end = std::min(begin + chords.size(), Size());
      SquaredChords(data_, pose, begin, end, chords.data());
      for (size_t i = 0; i < end - begin; ++i) {
        const bool inlier = chords[i] < max_squared_chord_;
        score.cost += inlier ? chords[i] : max_squared_chord_;
        score.num_inliers += inlier ? 1U : 0U;
      }
      if (gate.Rejects(score.cost, score.num_inliers, end)) return std::nullopt;
    }
    return score;
  }

  [[nodiscard]] Rigid3 Refine(const Rigid3& pose) const { return RefineOnInliers(pose, kLocalSteps); }

  [[nodiscard]] Rigid3 RefineOnInliers(const Rigid3& pose, int max_steps) const {
    std::vector<Vector3d> bearings;
    std::vector<Vector3d> points;
    const std::vector<uint8_t> is_inlier = Inliers(pose);
    for (size_t i = 0; i < Size(); ++i) {
      if (is_inlier[i] == 0) continue;
      bearings.push_back(data_.Bearing(i));
      points.push_back(data_.Point(i));
    }
    return MinimiseTangentResiduals(pose, bearings, points, 0.5 * max_error_rad_, max_steps);
  }

  [[nodiscard]] std::vector<uint8_t> Inliers(const Rigid3& pose) const {
    std::vector<double> chords(Size());
    SquaredChords(data_, pose, 0, Size(), chords.data());
    std::vector<uint8_t> is_inlier(Size());
    for (size_t i = 0; i < Size(); ++i) is_inlier[i] = chords[i] < max_squared_chord_ ? 1 : 0;
    return is_inlier;
  }

 private:
  const Correspondences& data_;
  double max_error_rad_;
  double max_squared_chord_;
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
AbsolutePose MakeResult(const AbsolutePoseEstimator& estimator, const Correspondences& data, const Rigid3& pose) {
  AbsolutePose result;
  result.cam_from_world = {pose.rotation, pose.translation - pose.rotation * data.origin};
  result.is_inlier.resize(data.Size());
  const std::vector<uint8_t> is_inlier = estimator.Inliers(pose);
  for (size_t i = 0; i < data.Size(); ++i) {
    result.is_inlier[data.order[i]] = is_inlier[i];
    result.num_inliers += is_inlier[i];
  }
  return result;
}

}  // namespace

absl::StatusOr<std::optional<AbsolutePose>> EstimateAbsolutePose(std::span<const Vector3d> bearings,
                                                                 std::span<const Vector3d> points_in_world,
                                                                 double max_error_rad,
                                                                 const AbsolutePoseOptions& options,
                                                                 const StageContext& context) {
  ORBWEAVE_CHECK(bearings.size() == points_in_world.size());
  const Correspondences data = Arrange(bearings, points_in_world, context.seed);
  const AbsolutePoseEstimator estimator(data, max_error_rad);
  const RansacOptions ransac = {.confidence = options.confidence, .max_trials = options.max_trials};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto best, Ransac(estimator, ransac, context));
  if (!best.model) return std::nullopt;
  AbsolutePose result = MakeResult(estimator, data, RefineToConvergence(estimator, *best.model));
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
    return MinimiseTangentResiduals(initial, bearings, points_in_world, 0.5 * max_error_rad, kMaxRefinementSteps);
  }
  std::vector<Vector3d> used_bearings;
  std::vector<Vector3d> used_points;
  for (size_t i = 0; i < is_inlier.size(); ++i) {
    if (is_inlier[i] == 0) continue;
    used_bearings.push_back(bearings[i]);
    used_points.push_back(points_in_world[i]);
  }
  return MinimiseTangentResiduals(initial, used_bearings, used_points, 0.5 * max_error_rad, kMaxRefinementSteps);
}

}  // namespace orbweave
