// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/steer_adjustment.h"

#include <algorithm>
#include <optional>
#include <utility>

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
    if (!WantsStep(path_.path.steps, PhaseBundle())) return EndPhase(false, answers.size());
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
            .shortened = path_.path.shortened,
            .control = path_.path.steps.control,
            .loss = PhaseBundle().loss};
  }

  SteeredRound AskAll(const BlockOrder& order, size_t num_blocks) {
    path_.asked = order.work;
    return {std::move(path_), std::vector<BlockOrder>(num_blocks, order)};
  }

  void Start(std::span<const BlockAnswer> answers) {
    std::vector<double> costs;
    std::vector<std::vector<SeparatorId>> separators;
    path_.report.num_observations = 0;
    for (const BlockAnswer& answer : answers) {
      costs.push_back(answer.cost);
      separators.push_back(answer.separators);
      path_.report.num_observations += answer.num_observations;
    }
    path_.path = StartBlockPath(costs, std::move(separators), PhaseBundle());
    const double cost = path_.path.steps.cost;
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
    const std::optional<SeparatorSolution> solution =
        SolveBlockStep(path_.path, std::move(systems));
    if (!solution) {
      if (!WantsStep(path_.path.steps, PhaseBundle())) return EndPhase(false, answers.size());
      return AskAll(Order(Work::kLinearise), answers.size());
    }
    SteeredRound round = AskAll(Order(Work::kTry), answers.size());
    for (size_t b = 0; b < answers.size(); ++b) round.orders[b].step = solution->step_of_block[b];
    return round;
  }

  SteeredRound TakeTrial(std::span<const BlockAnswer> answers) {
    std::vector<TrialCost> costs;
    for (const BlockAnswer& answer : answers) costs.push_back(answer.trial);
    JudgeBlockStep(path_.path, costs, PhaseBundle());
    const LevenbergMarquardt& steps = path_.path.steps;
    if (steps.accepted) path_.report.accepted_costs.back().push_back(steps.cost);
    BundleReport& report = path_.report.adjustments.back();
    report.final_cost = steps.cost;
    report.iterations = steps.iterations;
    report.converged = steps.converged;
    if (!WantsStep(steps, PhaseBundle())) return EndPhase(steps.accepted, answers.size());
    BlockOrder order = Order(Work::kLinearise);
    order.takes_trial = steps.accepted;
    return AskAll(order, answers.size());
  }

  SteeredRound EndPhase(bool takes_trial, size_t num_blocks) {
    const bool is_last = path_.phase == options_.rounds;
    ++path_.phase;
    path_.is_done = is_last;
    path_.path.steps = {.control = StartLevenbergMarquardt(0.0, bundle_).control};
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
  WorldPath path{.path = {.steps = StartLevenbergMarquardt(0.0, bundle)}};
  const BlockOrder order{.control = path.path.steps.control,
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
