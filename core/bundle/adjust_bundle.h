// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

enum class BundleLoss { kLeastSquares, kCauchy, kHuber };

template <>
struct EnumNames<BundleLoss> {
  static constexpr std::array<std::pair<BundleLoss, std::string_view>, 3> kNames = {
      {{BundleLoss::kLeastSquares, "least_squares"},
       {BundleLoss::kCauchy, "cauchy"},
       {BundleLoss::kHuber, "huber"}}};
};

/// How far a predicted ray lies from its bearing: by the angle between them, or as the paper's (11)
/// in the pixels of the equirectangular image (EvaluateErpResidual).
enum class BundleResidual { kAngle, kErpPx };

template <>
struct EnumNames<BundleResidual> {
  static constexpr std::array<std::pair<BundleResidual, std::string_view>, 2> kNames = {
      {{BundleResidual::kAngle, "angle"}, {BundleResidual::kErpPx, "erp_px"}}};
};

enum class BundleSolver { kSchur, kCeres };

template <>
struct EnumNames<BundleSolver> {
  static constexpr std::array<std::pair<BundleSolver, std::string_view>, 2> kNames = {
      {{BundleSolver::kSchur, "schur"}, {BundleSolver::kCeres, "ceres"}}};
};

/// How to solve.
struct BundleOptions {
  BundleLoss loss = BundleLoss::kCauchy;
  double loss_scale = 2.0;
  int max_iterations = 50;
  double function_tolerance = 1e-6;
  double initial_lambda = 1e-6;
  BundleSolver solver = BundleSolver::kSchur;
  BundleResidual residual = BundleResidual::kAngle;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("loss", self.loss, "robust loss of the bearing residuals");
    visit("loss_scale",
          self.loss_scale,
          "residual, in sigmas, where the loss starts to bite",
          Range{0.1, 100});
    visit(
        "max_iterations", self.max_iterations, "Levenberg-Marquardt steps at most", Range{1, 1000});
    visit("function_tolerance",
          self.function_tolerance,
          "stop when the cost falls by less than this share",
          Range{1e-16, 0.1});
    visit("initial_lambda", self.initial_lambda, "start damping", Range{1e-16, 1e6});
    visit("solver", self.solver, "our own Schur solver, or Ceres for comparison");
    visit("residual",
          self.residual,
          "what is minimised: the angle of a ray to its bearing, or its distance in pixels of the "
          "equirectangular image, which weighs high and low latitudes more");
  }
};

/// `point` seen by `pose` along `bearing`.
struct BundleObservation {
  uint32_t pose = 0;
  uint32_t point = 0;
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  double sigma_rad = 1e-3;
};

/// Robust prior on a camera centre: |diag(1/sigma) (C + bias[group] - position)|^2 under a Cauchy
/// loss of one sigma. Cameras of one drive share a bias group; no group, no bias.
struct PositionPrior {
  uint32_t pose = 0;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
  std::optional<uint32_t> bias_group{};
};

/// Prior on a rotation: R direction_in_world should be direction_in_cam, both unit; the angle
/// between them over sigma, squared. With many cameras it says how a world stands upright.
struct DirectionPrior {
  uint32_t pose = 0;
  Eigen::Vector3d direction_in_world = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d direction_in_cam = Eigen::Vector3d::UnitY();
  double sigma_rad = 0.1;
};

/// What to solve: poses (R, C), points and bearings, all in one world frame.
struct BundleProblem {
  std::vector<Rigid3> cams_from_world{};
  std::vector<uint8_t> pose_is_fixed{};  ///< empty: none
  std::vector<Eigen::Vector3d> points_in_world{};
  std::vector<uint8_t> point_is_fixed{};  ///< empty: none
  std::vector<BundleObservation> observations{};
  std::vector<PositionPrior> position_priors{};
  std::vector<DirectionPrior> direction_priors{};
  /// Sigma of the (zero) prior on each bias group's bias; its size is the number of groups.
  std::vector<double> bias_sigma_m{};
};

struct BundleReport {
  double initial_cost = 0.0;  ///< half the sum of losses
  double final_cost = 0.0;
  int iterations = 0;
  bool converged = false;
  std::vector<Eigen::Vector3d> biases_m{};
};

/// Minimises 1/2 sum rho(theta^2 / sigma^2) over poses and points, plus priors, by
/// Levenberg-Marquardt; theta is the angle between the predicted ray and the observed bearing. The
/// residual is the logarithm of the ray in the tangent plane of the bearing, which has theta as its
/// length and is as large behind the bearing as it should be; with options.residual erp_px it is
/// the difference in the equirectangular image instead (EvaluateErpResidual). Each pose is one
/// 6-dof block (R, C). Where neither fixed poses or points nor priors hold the gauge, the first
/// pose and the distance to the farthest other centre are held.
///
/// A pose or point without observations stays where it is. Same bytes for any
/// `context.num_threads`. InvalidArgument: an index out of range or a sigma that is not positive.
/// Cancelled when asked to stop (the problem then holds the last accepted step).
[[nodiscard]] absl::StatusOr<BundleReport> AdjustBundle(BundleProblem& problem,
                                                        const BundleOptions& options,
                                                        const StageContext& context);

/// InvalidArgument: an index out of range or a sigma that is not positive.
[[nodiscard]] absl::Status ValidateBundleProblem(const BundleProblem& problem);

/// Angle between predicted ray and observed bearing, radians.
[[nodiscard]] double BearingError(const Rigid3& cam_from_world,
                                  const Eigen::Vector3d& point_in_world,
                                  const Eigen::Vector3d& bearing);

}  // namespace orbweave
