// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/ceres_adjuster.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>

#include "core/bundle/bearing_residual.h"
#include "core/bundle/erp_residual.h"
#include "core/bundle/gauge.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kMaxPosesForDense = 30;

// Quaternion (x, y, z, w) and centre.
using PoseBlock = std::array<double, 7>;
using QuaternionMap = Eigen::Map<const Eigen::Quaterniond>;
using VectorMap = Eigen::Map<const Eigen::Vector3d>;

PoseBlock ToBlock(const Rigid3& cam_from_world) {
  PoseBlock block;
  Eigen::Map<Eigen::Vector4d>(block.data()) = cam_from_world.rotation.coeffs();
  Eigen::Map<Eigen::Vector3d>(block.data() + 4) = cam_from_world.Centre();
  return block;
}

Rigid3 FromBlock(const PoseBlock& block) {
  return Rigid3::FromCentre(QuaternionMap(block.data()).normalized(), VectorMap(block.data() + 4));
}

// d (q * exp(w)) / dw at w = 0; 4x3 with columns of length 1/2.
Eigen::Matrix<double, 4, 3> QuaternionFromTangent(const double* q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix<double, 4, 3> P;
  P << w, -z, y, z, w, -x, -y, x, w, -x, -y, -z;
  return 0.5 * P;
}

// R exp([w]x) and C + c: the pose perturbed on the right.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    Eigen::Map<Eigen::Quaterniond> q(x_plus_delta);
    q = (QuaternionMap(x) * RotationFromVector(VectorMap(delta))).normalized();
    Eigen::Map<Eigen::Vector3d>(x_plus_delta + 4) = VectorMap(x + 4) + VectorMap(delta + 3);
    return true;
  }
  bool PlusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.topLeftCorner<4, 3>() = QuaternionFromTangent(x);
    J.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Eigen::Vector3d> w(y_minus_x), c(y_minus_x + 3);
    w = VectorFromRotation(QuaternionMap(x).conjugate() * QuaternionMap(y));
    c = VectorMap(y + 4) - VectorMap(x + 4);
    return true;
  }
  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.topLeftCorner<3, 4>() = 4.0 * QuaternionFromTangent(x).transpose();
    J.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }
};

class BearingCost final : public ceres::SizedCostFunction<2, 7, 3> {
 public:
  BearingCost(const Eigen::Vector3d& bearing, double sigma_rad, BundleResidual kind)
      : bearing_(bearing),
        weight_(1.0 / sigma_rad),
        evaluate_(kind == BundleResidual::kErpPx ? EvaluateErpResidual : EvaluateBearingResidual) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const double* pose = parameters[0];
    const BearingResidual residual = evaluate_(QuaternionMap(pose).normalized().toRotationMatrix(),
                                               VectorMap(pose + 4),
                                               VectorMap(parameters[1]),
                                               bearing_);
    Eigen::Map<Eigen::Vector2d> r(residuals);
    r = weight_ * residual.r;
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> J(jacobians[0]);
      // Ceres multiplies by the manifold's P; 4 P^T is its pseudo-inverse.
      J.leftCols<4>() =
          4.0 * weight_ * residual.d_pose.leftCols<3>() * QuaternionFromTangent(pose).transpose();
      J.rightCols<3>() = weight_ * residual.d_pose.rightCols<3>();
    }
    if (jacobians && jacobians[1]) {
      Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> J(jacobians[1]);
      J = weight_ * residual.d_point;
    }
    return true;
  }

 private:
  Eigen::Vector3d bearing_;
  double weight_;
  decltype(&EvaluateBearingResidual) evaluate_;
};

// diag(1/sigma) (C + bias - position)
struct PositionCost {
  Eigen::Vector3d position_in_world;
  Eigen::Vector3d sigma_m;

  template <typename T>
  bool operator()(const T* pose, const T* bias, T* residuals) const {
    for (int i = 0; i < 3; ++i) {
      residuals[i] = (pose[4 + i] + bias[i] - position_in_world[i]) / sigma_m[i];
    }
    return true;
  }
};

class DirectionCost final : public ceres::SizedCostFunction<2, 7> {
 public:
  explicit DirectionCost(const DirectionPrior& prior) : prior_(prior) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const BearingResidual residual =
        EvaluateBearingResidual(QuaternionMap(parameters[0]).normalized().toRotationMatrix(),
                                Eigen::Vector3d::Zero(),
                                prior_.direction_in_world,
                                prior_.direction_in_cam);
    Eigen::Map<Eigen::Vector2d> r(residuals);
    r = residual.r / prior_.sigma_rad;
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> J(jacobians[0]);
      J.setZero();
      J.leftCols<4>() = 4.0 / prior_.sigma_rad * residual.d_pose.leftCols<3>() *
                        QuaternionFromTangent(parameters[0]).transpose();
    }
    return true;
  }

 private:
  DirectionPrior prior_;
};

struct BiasCost {
  double sigma_m;

  template <typename T>
  bool operator()(const T* bias, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = bias[i] / sigma_m;
    return true;
  }
};

class StopOnRequest final : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const StageContext& context) : context_(context) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return context_.CheckStop().ok() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  const StageContext& context_;
};

std::unique_ptr<ceres::LossFunction> MakeLoss(const BundleOptions& options) {
  switch (options.loss) {
    case BundleLoss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(options.loss_scale);
    case BundleLoss::kHuber:
      return std::make_unique<ceres::HuberLoss>(options.loss_scale);
    case BundleLoss::kLeastSquares:
      break;
  }
  return nullptr;
}

// Parameter blocks and the Ceres problem that points into them.
struct CeresBundle {
  std::vector<PoseBlock> poses{};
  std::vector<Eigen::Vector3d> points{};
  std::vector<Eigen::Vector3d> biases{};
  Eigen::Vector3d no_bias = Eigen::Vector3d::Zero();
  PoseManifold manifold{};
  std::deque<ceres::CauchyLoss> position_losses{};
  std::unique_ptr<ceres::LossFunction> loss{};
  std::unique_ptr<ceres::Problem> problem{};
  uint32_t num_free_poses = 0;
};

std::unique_ptr<ceres::Problem> MakeCeresProblem() {
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return std::make_unique<ceres::Problem>(ownership);
}

void AddObservations(const BundleProblem& problem,
                     const Gauge& gauge,
                     BundleResidual residual,
                     CeresBundle& bundle) {
  for (size_t i = 0; i < bundle.poses.size(); ++i) {
    bundle.problem->AddParameterBlock(bundle.poses[i].data(), 7, &bundle.manifold);
    if (gauge.pose_is_held[i]) {
      bundle.problem->SetParameterBlockConstant(bundle.poses[i].data());
    } else {
      ++bundle.num_free_poses;
    }
  }
  for (size_t i = 0; i < bundle.points.size(); ++i) {
    bundle.problem->AddParameterBlock(bundle.points[i].data(), 3);
    if (!problem.point_is_fixed.empty() && problem.point_is_fixed[i]) {
      bundle.problem->SetParameterBlockConstant(bundle.points[i].data());
    }
  }
  for (const BundleObservation& seen : problem.observations) {
    bundle.problem->AddResidualBlock(new BearingCost(seen.bearing, seen.sigma_rad, residual),
                                     bundle.loss.get(),
                                     bundle.poses[seen.pose].data(),
                                     bundle.points[seen.point].data());
  }
}

void AddDirectionPriors(const BundleProblem& problem, CeresBundle& bundle) {
  for (const DirectionPrior& prior : problem.direction_priors) {
    bundle.problem->AddResidualBlock(
        new DirectionCost(prior), nullptr, bundle.poses[prior.pose].data());
  }
}

void AddPositionPriors(const BundleProblem& problem, CeresBundle& bundle) {
  if (problem.position_priors.empty()) return;
  bundle.problem->AddParameterBlock(bundle.no_bias.data(), 3);
  bundle.problem->SetParameterBlockConstant(bundle.no_bias.data());
  for (size_t g = 0; g < bundle.biases.size(); ++g) {
    bundle.problem->AddParameterBlock(bundle.biases[g].data(), 3);
    if (problem.bias_sigma_m[g] > 0.0) {
      bundle.problem->AddResidualBlock(
          new ceres::AutoDiffCostFunction<BiasCost, 3, 3>(new BiasCost{problem.bias_sigma_m[g]}),
          nullptr,
          bundle.biases[g].data());
    } else {
      bundle.problem->SetParameterBlockConstant(bundle.biases[g].data());
    }
  }
  for (const PositionPrior& prior : problem.position_priors) {
    double* bias =
        prior.bias_group ? bundle.biases[*prior.bias_group].data() : bundle.no_bias.data();
    bundle.problem->AddResidualBlock(new ceres::AutoDiffCostFunction<PositionCost, 3, 7, 3>(
                                         new PositionCost{prior.position_in_world, prior.sigma_m}),
                                     &bundle.position_losses.emplace_back(prior.loss_sigmas),
                                     bundle.poses[prior.pose].data(),
                                     bias);
  }
}

ceres::Solver::Options MakeSolverOptions(const BundleOptions& options, uint32_t num_free_poses) {
  ceres::Solver::Options solver;
  solver.linear_solver_type =
      num_free_poses <= kMaxPosesForDense ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.gradient_tolerance = 0.0;
  solver.parameter_tolerance = 0.0;
  solver.initial_trust_region_radius = 1.0 / options.initial_lambda;
  solver.max_trust_region_radius = 1e16;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  return solver;
}

void WriteBack(const CeresBundle& bundle, const Gauge& gauge, BundleProblem& problem) {
  for (size_t i = 0; i < bundle.poses.size(); ++i) {
    if (!gauge.pose_is_held[i]) problem.cams_from_world[i] = FromBlock(bundle.poses[i]);
  }
  problem.points_in_world = bundle.points;
}

}  // namespace

absl::StatusOr<BundleReport> AdjustBundleWithCeres(BundleProblem& problem,
                                                   const BundleOptions& options,
                                                   const StageContext& context) {
  const Gauge gauge = ChooseGauge(problem);
  const double distance = HeldDistance(gauge, problem);
  CeresBundle bundle;
  for (const Rigid3& pose : problem.cams_from_world) bundle.poses.push_back(ToBlock(pose));
  bundle.points = problem.points_in_world;
  bundle.biases.assign(problem.bias_sigma_m.size(), Eigen::Vector3d::Zero());
  bundle.loss = MakeLoss(options);
  bundle.problem = MakeCeresProblem();
  AddObservations(problem, gauge, options.residual, bundle);
  AddPositionPriors(problem, bundle);
  AddDirectionPriors(problem, bundle);

  StopOnRequest stop(context);
  ceres::Solver::Options solver = MakeSolverOptions(options, bundle.num_free_poses);
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, bundle.problem.get(), &summary);

  WriteBack(bundle, gauge, problem);
  RestoreScale(gauge, distance, problem);
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  if (!summary.IsSolutionUsable()) return absl::InternalError("Ceres: " + summary.message);
  return BundleReport{
      .initial_cost = summary.initial_cost,
      .final_cost = summary.final_cost,
      .iterations = static_cast<int>(summary.iterations.size()) - 1,
      .converged = summary.termination_type == ceres::CONVERGENCE,
      .biases_m = bundle.biases,
  };
}

}  // namespace orbweave
