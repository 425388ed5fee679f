// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/subproblem_eliminator.h"

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

RetainedVariables KeptOf(const BundleSubproblem& subproblem) {
  RetainedVariables retained;
  for (const SeparatorId& id : subproblem.separators) {
    switch (id.kind) {
      case SeparatorId::Kind::kPose:
        retained.poses.push_back(LocalIndex(subproblem.pose_ids, id.index));
        break;
      case SeparatorId::Kind::kBias:
        retained.biases.push_back(LocalIndex(subproblem.bias_ids, id.index));
        break;
      case SeparatorId::Kind::kPoint:
        retained.points.push_back(LocalIndex(subproblem.point_ids, id.index));
        break;
    }
  }
  return retained;
}

}  // namespace

SubproblemEliminator::SubproblemEliminator(const BundleSubproblem& subproblem,
                                           const BundleOptions& options,
                                           int num_threads)
    : subproblem_(subproblem),
      eliminator_(subproblem.problem, subproblem.gauge, KeptOf(subproblem), options, num_threads) {}

SubproblemTrial SubproblemEliminator::Start() const {
  SubproblemTrial trial{.state = eliminator_.Start()};
  trial.cost.cost = eliminator_.Cost(trial.state);
  return trial;
}

SeparatorSystem SubproblemEliminator::Linearise(const EvaluatedState& state,
                                                const StepControl& control) {
  if (!eliminator_.Linearise(state, control)) return {.is_definite = false};
  return {.variables = subproblem_.separators, .normal = eliminator_.Remaining()};
}

SubproblemTrial SubproblemEliminator::BackSubstitute(const EvaluatedState& state,
                                                     const SeparatorStep& step) {
  SubproblemTrial trial;
  trial.cost = eliminator_.BackSubstitute(state, step.steps, trial.state);
  return trial;
}

BundleSubproblem SubproblemEliminator::Finish(const EvaluatedState& state, double scale) const {
  BundleSubproblem finished = subproblem_;
  WriteBack(eliminator_.layout(), state.variables, finished.problem);
  ScaleAboutAnchor(subproblem_.gauge, scale, finished.problem);
  return finished;
}

double SubproblemEliminator::HeldDistance(const EvaluatedState& state) const {
  if (!subproblem_.gauge.farthest) return 0.0;
  return (state.variables.poses[*subproblem_.gauge.farthest].centre -
          state.variables.poses[*subproblem_.gauge.anchor].centre)
      .norm();
}

EvaluatedState Accepted(const BundleSubproblem& subproblem,
                        EvaluatedState trial,
                        const std::vector<ShortenedPoint>& shortened) {
  size_t retained = 0;
  for (const SeparatorId& id : subproblem.separators) {
    if (id.kind != SeparatorId::Kind::kPoint) continue;
    const Eigen::Vector3d& before = trial.retained_points_before[retained++];
    const auto it = std::lower_bound(
        shortened.begin(), shortened.end(), id.index, [](const ShortenedPoint& x, uint32_t point) {
          return x.point < point;
        });
    if (it == shortened.end() || it->point != id.index) continue;
    Eigen::Vector3d& after = trial.variables.points[LocalIndex(subproblem.point_ids, id.index)];
    after = before + it->share * (after - before);
  }
  return trial;
}

}  // namespace orbweave
