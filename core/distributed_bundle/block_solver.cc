// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/distributed_bundle/block_solver.h"

#include <algorithm>

#include "core/base/status.h"

namespace orbweave {
namespace {

// The place of a whole problem's index in ascending `ids`.
uint32_t LocalIndex(const std::vector<uint32_t>& ids, uint32_t index) {
  const auto it = std::lower_bound(ids.begin(), ids.end(), index);
  ORBWEAVE_CHECK(it != ids.end() && *it == index);
  return static_cast<uint32_t>(it - ids.begin());
}

KeptVariables KeptOf(const AdjustmentBlock& block) {
  KeptVariables kept;
  for (const SeparatorId& id : block.separators) {
    switch (id.kind) {
      case SeparatorId::Kind::kPose:
        kept.poses.push_back(LocalIndex(block.pose_ids, id.index));
        break;
      case SeparatorId::Kind::kBias:
        kept.biases.push_back(LocalIndex(block.bias_ids, id.index));
        break;
      case SeparatorId::Kind::kPoint:
        kept.points.push_back(LocalIndex(block.point_ids, id.index));
        break;
    }
  }
  return kept;
}

}  // namespace

BlockSolver::BlockSolver(const AdjustmentBlock& block,
                         const BundleOptions& options,
                         int num_threads)
    : block_(block), eliminator_(block.problem, block.gauge, KeptOf(block), options, num_threads) {}

BlockTrial BlockSolver::Start() const {
  BlockTrial trial{.state = eliminator_.Start()};
  trial.cost.cost = eliminator_.Cost(trial.state);
  return trial;
}

SeparatorSystem BlockSolver::Linearize(const EvaluatedState& state, const StepControl& control) {
  if (!eliminator_.Linearize(state, control)) return {.is_definite = false};
  return {.variables = block_.separators, .normal = eliminator_.Remaining()};
}

BlockTrial BlockSolver::BackSubstitute(const EvaluatedState& state, const SeparatorStep& step) {
  BlockTrial trial;
  trial.cost = eliminator_.BackSubstitute(state, step.steps, trial.state);
  return trial;
}

AdjustmentBlock BlockSolver::Finish(const EvaluatedState& state, double scale) const {
  AdjustmentBlock finished = block_;
  WriteBack(eliminator_.layout(), state.variables, finished.problem);
  ScaleAboutAnchor(block_.gauge, scale, finished.problem);
  return finished;
}

double BlockSolver::HeldDistance(const EvaluatedState& state) const {
  if (!block_.gauge.farthest) return 0.0;
  return (state.variables.poses[*block_.gauge.farthest].centre -
          state.variables.poses[*block_.gauge.anchor].centre)
      .norm();
}

SeparatorSystem LinearizeBlock(const AdjustmentBlock& block,
                               const EvaluatedState& state,
                               const StepControl& control,
                               const BundleOptions& options,
                               int num_threads) {
  return BlockSolver(block, options, num_threads).Linearize(state, control);
}

BlockTrial BackSubstituteBlock(const AdjustmentBlock& block,
                               const EvaluatedState& state,
                               const StepControl& control,
                               const SeparatorStep& step,
                               const BundleOptions& options,
                               int num_threads) {
  BlockSolver solver(block, options, num_threads);
  // Deterministic: it was definite when the separators were solved.
  ORBWEAVE_CHECK(solver.Linearize(state, control).is_definite);
  return solver.BackSubstitute(state, step);
}

EvaluatedState Accepted(const AdjustmentBlock& block,
                        EvaluatedState trial,
                        const std::vector<ShortenedPoint>& shortened) {
  size_t kept = 0;
  for (const SeparatorId& id : block.separators) {
    if (id.kind != SeparatorId::Kind::kPoint) continue;
    const Eigen::Vector3d& before = trial.kept_points_before[kept++];
    const auto it = std::lower_bound(
        shortened.begin(), shortened.end(), id.index, [](const ShortenedPoint& x, uint32_t point) {
          return x.point < point;
        });
    if (it == shortened.end() || it->point != id.index) continue;
    Eigen::Vector3d& after = trial.variables.points[LocalIndex(block.point_ids, id.index)];
    after = before + it->share * (after - before);
  }
  return trial;
}

}  // namespace orbweave
