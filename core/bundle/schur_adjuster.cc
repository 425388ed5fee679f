// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/schur_adjuster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bundle/block_cholesky.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/gauge.h"
#include "core/bundle/prior_terms.h"
#include "core/bundle/reduced_system.h"
#include "core/bundle/trial_step.h"

namespace orbweave {
namespace {

// Below, the depth of a point seen once is lost in rounding; above, a step no longer moves
// anything.
constexpr double kMinLambda = 1e-12;
constexpr double kMaxLambda = 1e12;
// Relative decrease below which the loss is linearised as Newton would: it ends the slow
// convergence of the weights, and leads astray far from the optimum.
constexpr double kBendBelow = 0.01;

BundleState StateOf(const BundleProblem& problem) {
  BundleState state;
  for (const Rigid3& cam_from_world : problem.cams_from_world) {
    const Eigen::Quaterniond rotation = cam_from_world.rotation.normalized();
    state.poses.push_back(
        {rotation, rotation.conjugate().toRotationMatrix(), cam_from_world.Centre()});
  }
  state.points = problem.points_in_world;
  state.biases.assign(problem.bias_sigma_m.size(), Eigen::Vector3d::Zero());
  return state;
}

// Held poses and points without observations keep their bits.
void WriteBack(const BundleLayout& layout, const BundleState& state, BundleProblem& problem) {
  for (size_t i = 0; i < state.poses.size(); ++i) {
    if (layout.pose_block[i] == kHeld) continue;
    problem.cams_from_world[i] = Rigid3::FromCentre(state.poses[i].rotation, state.poses[i].centre);
  }
  problem.points_in_world = state.points;
}

// One solve: its structure, its state and its workspaces.
class SchurSolver {
 public:
  SchurSolver(const BundleProblem& problem,
              const Gauge& gauge,
              const BundleOptions& options,
              int num_threads)
      : problem_(problem),
        gauge_(gauge),
        options_(options),
        num_threads_(num_threads),
        loss_(options.loss, options.loss_scale),
        layout_(MakeBundleLayout(problem, gauge)),
        cholesky_(layout_.matrix),
        reducer_(layout_, num_threads),
        stepper_(layout_, num_threads),
        system_(MakeReducedSystem(layout_)),
        state_(StateOf(problem)),
        trial_(state_),
        lambda_(std::max(options.initial_lambda, kMinLambda)) {}

  absl::Status Solve(const StageContext& context) {
    costs_ = EvaluatePointCosts(layout_, state_, loss_, num_threads_);
    cost_ = costs_.total + PriorCost(problem_, state_);
    report_.initial_cost = cost_;
    absl::Status status;
    while (!report_.converged && report_.iterations < options_.max_iterations &&
           lambda_ <= kMaxLambda) {
      status = context.CheckStop();
      if (!status.ok()) break;
      ++report_.iterations;
      TakeStep();
    }
    report_.final_cost = cost_;
    report_.biases_m = state_.biases;
    return status;
  }

  [[nodiscard]] const BundleLayout& layout() const { return layout_; }
  [[nodiscard]] const BundleState& state() const { return state_; }
  [[nodiscard]] BundleReport TakeReport() { return std::move(report_); }

 private:
  void TakeStep() {
    FormSystem();
    if (!cholesky_.Factorize(system_.S)) return Reject();
    step_ = system_.rhs;
    cholesky_.Solve(step_);
    StepBlocks(layout_, state_, step_, trial_);
    const double predicted =
        PredictedByBlocks() +
        stepper_.StepPoints(state_, loss_, step_, system_, costs_, trial_, trial_costs_);
    const double trial_cost = trial_costs_.total + PriorCost(problem_, trial_);
    if (trial_cost < cost_) return Accept(trial_cost, predicted);
    // Nothing left to gain: the decrease drowns in the rounding of the cost.
    report_.converged = predicted <= 1e-13 * cost_;
    Reject();
  }

  void FormSystem() {
    Clear(system_);
    reducer_.AddBearings(state_, loss_, lambda_, system_);
    AddPriorTerms(problem_, layout_, state_, system_);
    HoldDistance();
    DampPoses(lambda_, system_);
  }

  // A spring on the held distance. The gradient has no part along the scale, so that the step, too,
  // has none, whatever the spring's stiffness.
  void HoldDistance() {
    if (!gauge_.farthest) return;
    const uint32_t block = layout_.pose_block[*gauge_.farthest];
    const Eigen::Vector3d axis =
        (state_.poses[*gauge_.farthest].centre - state_.poses[*gauge_.anchor].centre).normalized();
    const double stiffness = system_.trace[block][1] / 3.0;
    system_.S.Diagonal(block).bottomRightCorner<3, 3>() += stiffness * axis * axis.transpose();
  }

  [[nodiscard]] double PredictedByBlocks() const {
    double decrease = 0.0;
    for (uint32_t block = 0; block < layout_.num_blocks; ++block) {
      const Vector6& step = step_[block];
      decrease +=
          0.5 * (system_.damping[block].dot(step.cwiseAbs2()) - system_.gradient[block].dot(step));
    }
    return decrease;
  }

  void Accept(double trial_cost, double predicted) {
    const double decrease = cost_ - trial_cost;
    loss_ = loss_.Bent(decrease < kBendBelow * cost_);
    report_.converged = decrease <= options_.function_tolerance * cost_;
    std::swap(state_, trial_);
    std::swap(costs_, trial_costs_);
    cost_ = trial_cost;
    const double gain = predicted > 0.0 ? decrease / predicted : 0.0;
    lambda_ =
        std::max(kMinLambda, lambda_ * std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3)));
    growth_ = 2.0;
  }

  void Reject() {
    loss_ = loss_.Bent(false);
    lambda_ *= growth_;
    growth_ *= 2.0;
  }

  const BundleProblem& problem_;
  const Gauge& gauge_;
  const BundleOptions& options_;
  int num_threads_;
  RobustLoss loss_;
  BundleLayout layout_;
  BlockCholesky cholesky_;
  BearingReducer reducer_;
  PointStepper stepper_;
  ReducedSystem system_;
  BundleState state_;
  BundleState trial_;
  PointCosts costs_{};
  PointCosts trial_costs_{};
  std::vector<Vector6> step_{};
  double cost_ = 0.0;
  double lambda_;
  double growth_ = 2.0;
  BundleReport report_{};
};

}  // namespace

absl::StatusOr<BundleReport> AdjustBundleWithSchur(BundleProblem& problem,
                                                   const BundleOptions& options,
                                                   const StageContext& context) {
  const Gauge gauge = ChooseGauge(problem);
  const double distance = HeldDistance(gauge, problem);
  SchurSolver solver(problem, gauge, options, context.num_threads);
  const absl::Status status = solver.Solve(context);
  WriteBack(solver.layout(), solver.state(), problem);
  RestoreScale(gauge, distance, problem);
  ORBWEAVE_RETURN_IF_ERROR(status);
  return solver.TakeReport();
}

}  // namespace orbweave
