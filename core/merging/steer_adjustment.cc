// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/steer_adjustment.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/distributed_bundle/judge_trial.h"
#include "core/distributed_bundle/solve_along_tree.h"

namespace orbweave {
namespace {

using Work = BlockOrder::Work;

class Steering {
 public:
  Steering(WorldPath path, const GlobalAdjustOptions& options, const BundleOptions& bundle)
      : path_(std::move(path)), options_(options), bundle_(bundle) {}

  SteeredRound Take(std::span<const BlockAnswer> answers) {
    if (path_.asked == Work::kFilter) TakeFiltered(answers);
    if (path_.asked == Work::kFilter && path_.is_done) return {std::move(path_), {}};
    if (path_.asked == Work::kTry) return TakeTrial(answers);
    if (path_.asked != Work::kLinearise) Start(answers);
    if (!WantsStep(path_.path, PhaseBundle())) return EndPhase(false, answers.size());
    return TakeSystems(answers);
  }

 private:
  [[nodiscard]] BundleOptions PhaseBundle() const {
    BundleOptions bundle = bundle_;
    if (path_.phase == options_.rounds) bundle.loss = BundleLoss::kLeastSquares;
    return bundle;
  }

  [[nodiscard]] BlockOrder Order(Work work) const {
    return {.work = work,
            .shortened = path_.shortened,
            .control = path_.path.control,
            .loss = PhaseBundle().loss};
  }

  SteeredRound AskAll(const BlockOrder& order, size_t num_blocks) {
    path_.asked = order.work;
    return {std::move(path_), std::vector<BlockOrder>(num_blocks, order)};
  }

  void Start(std::span<const BlockAnswer> answers) {
    double cost = 0.0;
    path_.separators_of_block.clear();
    path_.report.num_observations = 0;
    for (const BlockAnswer& answer : answers) {
      cost += answer.cost;
      path_.report.num_observations += answer.num_observations;
      path_.separators_of_block.push_back(answer.separators);
    }
    path_.shortened.clear();
    path_.path = StartLevenbergMarquardt(cost, PhaseBundle());
    path_.report.adjustments.push_back({.initial_cost = cost, .final_cost = cost});
    path_.report.accepted_costs.push_back({cost});
  }

  SteeredRound TakeSystems(std::span<const BlockAnswer> answers) {
    std::vector<SeparatorSystem> systems;
    std::vector<uint64_t>& bytes = path_.report.bytes_of_block;
    bytes.resize(answers.size());
    for (size_t b = 0; b < answers.size(); ++b) {
      systems.push_back(answers[b].system);
      bytes[b] = std::max<uint64_t>(bytes[b], PayloadBytes(systems.back()));
    }
    const SeparatorTree tree = MakeSeparatorTree(path_.separators_of_block);
    const std::optional<SeparatorSolution> solution =
        SolveAlongTree(tree, std::move(systems), path_.path.control.lambda);
    if (!solution) {
      path_.path = AfterFailure(path_.path);
      if (!WantsStep(path_.path, PhaseBundle())) return EndPhase(false, answers.size());
      return AskAll(Order(Work::kLinearise), answers.size());
    }
    path_.separators_decrease = solution->predicted_decrease;
    SteeredRound round = AskAll(Order(Work::kTry), answers.size());
    for (size_t b = 0; b < answers.size(); ++b) round.orders[b].step = solution->step_of_block[b];
    return round;
  }

  SteeredRound TakeTrial(std::span<const BlockAnswer> answers) {
    std::vector<TrialCost> costs;
    for (const BlockAnswer& answer : answers) costs.push_back(answer.trial);
    const JudgedTrial judged =
        JudgeTrial(path_.separators_of_block, costs, path_.separators_decrease);
    path_.path = AfterTrial(path_.path, judged.cost, judged.predicted_decrease, PhaseBundle());
    const bool accepted = path_.path.accepted;
    if (accepted) {
      path_.shortened = judged.shortened;
      path_.report.accepted_costs.back().push_back(judged.cost);
    }
    BundleReport& report = path_.report.adjustments.back();
    report.final_cost = path_.path.cost;
    report.iterations = path_.path.iterations;
    report.converged = path_.path.converged;
    if (!WantsStep(path_.path, PhaseBundle())) return EndPhase(accepted, answers.size());
    BlockOrder order = Order(Work::kLinearise);
    order.takes_trial = accepted;
    return AskAll(order, answers.size());
  }

  SteeredRound EndPhase(bool takes_trial, size_t num_blocks) {
    const bool is_last = path_.phase == options_.rounds;
    ++path_.phase;
    path_.is_done = is_last;
    path_.path = {.control = StartLevenbergMarquardt(0.0, bundle_).control};
    BlockOrder order = Order(Work::kFilter);
    order.takes_trial = takes_trial;
    order.begins_again = !is_last;
    return AskAll(order, num_blocks);
  }

  void TakeFiltered(std::span<const BlockAnswer> answers) {
    for (const BlockAnswer& answer : answers) {
      path_.report.removed_observations += answer.removed_observations;
      path_.report.removed_tracks += answer.removed_tracks;
    }
  }

  WorldPath path_;
  const GlobalAdjustOptions& options_;
  const BundleOptions& bundle_;
};

}  // namespace

SteeredRound BeginAdjustment(size_t num_blocks,
                             const GlobalAdjustOptions& options,
                             const BundleOptions& bundle) {
  WorldPath path{.path = StartLevenbergMarquardt(0.0, bundle)};
  const BlockOrder order{.control = path.path.control,
                         .loss = options.rounds == 0 ? BundleLoss::kLeastSquares : bundle.loss};
  return {std::move(path), std::vector<BlockOrder>(num_blocks, order)};
}

SteeredRound SteerAdjustment(WorldPath path,
                             std::span<const BlockAnswer> answers,
                             const GlobalAdjustOptions& options,
                             const BundleOptions& bundle) {
  return Steering(std::move(path), options, bundle).Take(answers);
}

}  // namespace orbweave
