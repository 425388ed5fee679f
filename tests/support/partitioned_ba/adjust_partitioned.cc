// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/partitioned_ba/adjust_partitioned.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/partitioned_ba/partitioned_lm.h"
#include "tests/support/partitioned_ba/divide_bundle.h"

namespace orbweave {
namespace {

absl::Status ValidateOwners(const BundleProblem& problem,
                            const std::vector<uint32_t>& owner_of_pose,
                            uint32_t num_subproblems) {
  if (num_subproblems == 0) return absl::InvalidArgumentError("num_blocks must be positive");
  if (owner_of_pose.size() != problem.cams_from_world.size()) {
    return absl::InvalidArgumentError("owner_of_pose has " + std::to_string(owner_of_pose.size()) +
                                      " entries, there are " +
                                      std::to_string(problem.cams_from_world.size()) + " poses");
  }
  for (const uint32_t owner : owner_of_pose) {
    if (owner < num_subproblems) continue;
    return absl::InvalidArgumentError("owner " + std::to_string(owner) +
                                      " is out of range, there are " +
                                      std::to_string(num_subproblems) + " blocks");
  }
  return absl::OkStatus();
}

// All subproblems of one problem and where they stand.
class PartitionedSolver {
 public:
  PartitionedSolver(const std::vector<BundleSubproblem>& subproblems,
                    const BundleOptions& options,
                    int num_threads)
      : options_(options),
        num_threads_(num_threads),
        solvers_(subproblems.size()),
        states_(subproblems.size()),
        subproblems_(subproblems) {}

  absl::Status Solve(const StageContext& context) {
    Start();
    absl::Status status;
    while (WantsStep(path_.steps, options_) && (status = context.CheckStop()).ok()) {
      TakeStep();
      if (path_.steps.accepted) report_.accepted_costs.push_back(path_.steps.cost);
    }
    return status;
  }

  [[nodiscard]] std::vector<BundleSubproblem> Finish() const {
    const double distance = HeldDistance();
    const double scale = distance > 0.0 ? start_distance_ / distance : 1.0;
    std::vector<BundleSubproblem> finished(subproblems_.size());
    ForEachSubproblem([&](size_t b) { finished[b] = solvers_[b]->Finish(states_[b], scale); });
    return finished;
  }

  [[nodiscard]] PartitionedReport Report(size_t num_biases) const {
    PartitionedReport report = report_;
    report.bundle.initial_cost = report.accepted_costs.front();
    report.bundle.final_cost = path_.steps.cost;
    report.bundle.iterations = path_.steps.iterations;
    report.bundle.converged = path_.steps.converged;
    report.bundle.biases_m.assign(num_biases, Eigen::Vector3d::Zero());
    for (size_t b = 0; b < subproblems_.size(); ++b) {
      for (size_t i = 0; i < subproblems_[b].bias_ids.size(); ++i) {
        report.bundle.biases_m[subproblems_[b].bias_ids[i]] = states_[b].variables.biases[i];
      }
      report.separators_of_subproblem.push_back(
          static_cast<uint32_t>(subproblems_[b].separators.size()));
    }
    return report;
  }

 private:
  template <typename Body>
  void ForEachSubproblem(const Body& body) const {
    ParallelFor(subproblems_.size(), num_threads_, body);
  }

  void Start() {
    std::vector<double> costs(subproblems_.size());
    ForEachSubproblem([&](size_t b) {
      solvers_[b] = std::make_unique<SubproblemEliminator>(subproblems_[b], options_, 1);
      SubproblemTrial start = solvers_[b]->Start();
      costs[b] = start.cost.cost;
      states_[b] = std::move(start.state);
    });
    std::vector<std::vector<SeparatorId>> separators;
    for (const BundleSubproblem& subproblem : subproblems_)
      separators.push_back(subproblem.separators);
    path_ = StartPartitionedLm(costs, std::move(separators), options_);
    report_.accepted_costs.push_back(path_.steps.cost);
    report_.message_bytes_of_subproblem.assign(subproblems_.size(), 0);
    start_distance_ = HeldDistance();
  }

  void TakeStep() {
    std::vector<SeparatorSystem> systems(subproblems_.size());
    ForEachSubproblem(
        [&](size_t b) { systems[b] = solvers_[b]->Linearise(states_[b], path_.steps.control); });
    for (size_t b = 0; b < systems.size(); ++b) {
      report_.message_bytes_of_subproblem[b] =
          std::max(report_.message_bytes_of_subproblem[b], PayloadBytes(systems[b]));
    }
    const std::optional<SeparatorSolution> solution =
        SolvePartitionedStep(path_, std::move(systems));
    if (!solution) return;
    report_.largest_node_bytes = std::max(report_.largest_node_bytes, solution->largest_node_bytes);
    TryStep(*solution);
  }

  void TryStep(const SeparatorSolution& solution) {
    std::vector<EvaluatedState> trials(subproblems_.size());
    std::vector<TrialCost> costs(subproblems_.size());
    ForEachSubproblem([&](size_t b) {
      SubproblemTrial trial =
          solvers_[b]->BackSubstitute(states_[b], solution.step_of_subproblem[b]);
      trials[b] = std::move(trial.state);
      costs[b] = std::move(trial.cost);
    });
    JudgePartitionedStep(path_, costs, options_);
    if (!path_.steps.accepted) return;
    ForEachSubproblem([&](size_t b) {
      states_[b] = Accepted(subproblems_[b], std::move(trials[b]), path_.shortened);
    });
  }

  // Of the first subproblem that has both ends; all copies are equal.
  [[nodiscard]] double HeldDistance() const {
    for (size_t b = 0; b < subproblems_.size(); ++b) {
      const double distance = solvers_[b]->HeldDistance(states_[b]);
      if (distance > 0.0) return distance;
    }
    return 0.0;
  }

  const BundleOptions& options_;
  int num_threads_;
  std::vector<std::unique_ptr<SubproblemEliminator>> solvers_;
  std::vector<EvaluatedState> states_;
  const std::vector<BundleSubproblem>& subproblems_;
  PartitionedLm path_{};
  double start_distance_ = 0.0;
  PartitionedReport report_{};
};

}  // namespace

absl::StatusOr<PartitionedReport> AdjustPartitioned(BundleProblem& problem,
                                                    const std::vector<uint32_t>& owner_of_pose,
                                                    uint32_t num_subproblems,
                                                    const BundleOptions& options,
                                                    const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(ValidateBundleProblem(problem));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOwners(problem, owner_of_pose, num_subproblems));
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const std::vector<BundleSubproblem> subproblems =
      DivideBundle(problem, owner_of_pose, num_subproblems);
  PartitionedSolver solver(subproblems, options, context.num_threads);
  const absl::Status status = solver.Solve(context);
  GatherBundle(solver.Finish(), problem);
  ORBWEAVE_RETURN_IF_ERROR(status);
  return solver.Report(problem.bias_sigma_m.size());
}

}  // namespace orbweave
