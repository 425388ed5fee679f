// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/adjust_in_blocks.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/distributed_bundle/block_path.h"
#include "core/distributed_bundle/divide_into_blocks.h"

namespace orbweave {
namespace {

absl::Status ValidateOwners(const BundleProblem& problem,
                            const std::vector<uint32_t>& owner_of_pose,
                            uint32_t num_blocks) {
  if (num_blocks == 0) return absl::InvalidArgumentError("num_blocks must be positive");
  if (owner_of_pose.size() != problem.cams_from_world.size()) {
    return absl::InvalidArgumentError("owner_of_pose has " + std::to_string(owner_of_pose.size()) +
                                      " entries, there are " +
                                      std::to_string(problem.cams_from_world.size()) + " poses");
  }
  for (const uint32_t owner : owner_of_pose) {
    if (owner < num_blocks) continue;
    return absl::InvalidArgumentError("owner " + std::to_string(owner) +
                                      " is out of range, there are " + std::to_string(num_blocks) +
                                      " blocks");
  }
  return absl::OkStatus();
}

// All blocks of one problem and where they stand.
class BlockwiseSolver {
 public:
  BlockwiseSolver(const std::vector<AdjustmentBlock>& blocks,
                  const BundleOptions& options,
                  int num_threads)
      : options_(options),
        num_threads_(num_threads),
        solvers_(blocks.size()),
        states_(blocks.size()),
        blocks_(blocks) {}

  absl::Status Solve(const StageContext& context) {
    Start();
    absl::Status status;
    while (WantsStep(path_.steps, options_) && (status = context.CheckStop()).ok()) {
      TakeStep();
      if (path_.steps.accepted) report_.accepted_costs.push_back(path_.steps.cost);
    }
    return status;
  }

  [[nodiscard]] std::vector<AdjustmentBlock> Finish() const {
    const double distance = HeldDistance();
    const double scale = distance > 0.0 ? start_distance_ / distance : 1.0;
    std::vector<AdjustmentBlock> finished(blocks_.size());
    ForEachBlock([&](size_t b) { finished[b] = solvers_[b]->Finish(states_[b], scale); });
    return finished;
  }

  [[nodiscard]] BlockwiseReport Report(size_t num_biases) const {
    BlockwiseReport report = report_;
    report.bundle.initial_cost = report.accepted_costs.front();
    report.bundle.final_cost = path_.steps.cost;
    report.bundle.iterations = path_.steps.iterations;
    report.bundle.converged = path_.steps.converged;
    report.bundle.biases_m.assign(num_biases, Eigen::Vector3d::Zero());
    for (size_t b = 0; b < blocks_.size(); ++b) {
      for (size_t i = 0; i < blocks_[b].bias_ids.size(); ++i) {
        report.bundle.biases_m[blocks_[b].bias_ids[i]] = states_[b].variables.biases[i];
      }
      report.separators_of_block.push_back(static_cast<uint32_t>(blocks_[b].separators.size()));
    }
    return report;
  }

 private:
  template <typename Body>
  void ForEachBlock(const Body& body) const {
    ParallelFor(blocks_.size(), num_threads_, body);
  }

  void Start() {
    std::vector<double> costs(blocks_.size());
    ForEachBlock([&](size_t b) {
      solvers_[b] = std::make_unique<BlockSolver>(blocks_[b], options_, 1);
      BlockTrial start = solvers_[b]->Start();
      costs[b] = start.cost.cost;
      states_[b] = std::move(start.state);
    });
    std::vector<std::vector<SeparatorId>> separators;
    for (const AdjustmentBlock& block : blocks_) separators.push_back(block.separators);
    path_ = StartBlockPath(costs, std::move(separators), options_);
    report_.accepted_costs.push_back(path_.steps.cost);
    report_.message_bytes_of_block.assign(blocks_.size(), 0);
    start_distance_ = HeldDistance();
  }

  void TakeStep() {
    std::vector<SeparatorSystem> systems(blocks_.size());
    ForEachBlock(
        [&](size_t b) { systems[b] = solvers_[b]->Linearize(states_[b], path_.steps.control); });
    for (size_t b = 0; b < systems.size(); ++b) {
      report_.message_bytes_of_block[b] =
          std::max(report_.message_bytes_of_block[b], PayloadBytes(systems[b]));
    }
    const std::optional<SeparatorSolution> solution = SolveBlockStep(path_, std::move(systems));
    if (!solution) return;
    report_.largest_node_bytes = std::max(report_.largest_node_bytes, solution->largest_node_bytes);
    TryStep(*solution);
  }

  void TryStep(const SeparatorSolution& solution) {
    std::vector<EvaluatedState> trials(blocks_.size());
    std::vector<TrialCost> costs(blocks_.size());
    ForEachBlock([&](size_t b) {
      BlockTrial trial = solvers_[b]->BackSubstitute(states_[b], solution.step_of_block[b]);
      trials[b] = std::move(trial.state);
      costs[b] = std::move(trial.cost);
    });
    JudgeBlockStep(path_, costs, options_);
    if (!path_.steps.accepted) return;
    ForEachBlock([&](size_t b) {
      states_[b] = Accepted(blocks_[b], std::move(trials[b]), path_.shortened);
    });
  }

  // Of the first block that has both ends; all copies are equal.
  [[nodiscard]] double HeldDistance() const {
    for (size_t b = 0; b < blocks_.size(); ++b) {
      const double distance = solvers_[b]->HeldDistance(states_[b]);
      if (distance > 0.0) return distance;
    }
    return 0.0;
  }

  const BundleOptions& options_;
  int num_threads_;
  std::vector<std::unique_ptr<BlockSolver>> solvers_;
  std::vector<EvaluatedState> states_;
  const std::vector<AdjustmentBlock>& blocks_;
  BlockPath path_{};
  double start_distance_ = 0.0;
  BlockwiseReport report_{};
};

}  // namespace

absl::StatusOr<BlockwiseReport> AdjustInBlocks(BundleProblem& problem,
                                               const std::vector<uint32_t>& owner_of_pose,
                                               uint32_t num_blocks,
                                               const BundleOptions& options,
                                               const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(ValidateBundleProblem(problem));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOwners(problem, owner_of_pose, num_blocks));
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const std::vector<AdjustmentBlock> blocks = DivideIntoBlocks(problem, owner_of_pose, num_blocks);
  BlockwiseSolver solver(blocks, options, context.num_threads);
  const absl::Status status = solver.Solve(context);
  GatherBlocks(solver.Finish(), problem);
  ORBWEAVE_RETURN_IF_ERROR(status);
  return solver.Report(problem.bias_sigma_m.size());
}

}  // namespace orbweave
