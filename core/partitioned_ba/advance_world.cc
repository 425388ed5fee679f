// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/advance_world.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace orbweave {
namespace {

using Work = LmRequest::Work;

class Advancing {
 public:
  Advancing(WorldProgress path, const GlobalAdjustOptions& options, const BundleOptions& bundle)
      : path_(std::move(path)), options_(options), bundle_(bundle) {}

  WorldRound Take(std::span<const LmReply> replies) {
    if (path_.asked == Work::kFilter) TakeFiltered(replies);
    if (path_.asked == Work::kFilter && path_.is_done) return {std::move(path_), {}};
    if (path_.asked == Work::kTrial) return TakeTrial(replies);
    if (path_.asked != Work::kLinearise) Start(replies);
    if (!WantsStep(path_.path.steps, PhaseBundle())) return EndPhase(false, replies.size());
    return TakeSystems(replies);
  }

 private:
  [[nodiscard]] BundleOptions PhaseBundle() const {
    BundleOptions bundle = bundle_;
    if (path_.phase == options_.rounds) bundle.loss = BundleLoss::kLeastSquares;
    return bundle;
  }

  [[nodiscard]] LmRequest Request(Work work) const {
    return {.work = work,
            .shortened = path_.path.shortened,
            .control = path_.path.steps.control,
            .loss = PhaseBundle().loss};
  }

  WorldRound AskAll(const LmRequest& request, size_t num_subproblems) {
    path_.asked = request.work;
    return {std::move(path_), std::vector<LmRequest>(num_subproblems, request)};
  }

  void Start(std::span<const LmReply> replies) {
    std::vector<double> costs;
    std::vector<std::vector<SeparatorId>> separators;
    path_.report.num_observations = 0;
    for (const LmReply& reply : replies) {
      costs.push_back(reply.cost);
      separators.push_back(reply.separators);
      path_.report.num_observations += reply.num_observations;
    }
    path_.path = StartPartitionedLm(costs, std::move(separators), PhaseBundle());
    const double cost = path_.path.steps.cost;
    path_.report.adjustments.push_back({.initial_cost = cost, .final_cost = cost});
    path_.report.accepted_costs.push_back({cost});
  }

  WorldRound TakeSystems(std::span<const LmReply> replies) {
    std::vector<SeparatorSystem> systems;
    std::vector<uint64_t>& bytes = path_.report.bytes_of_subproblem;
    bytes.resize(replies.size());
    for (size_t b = 0; b < replies.size(); ++b) {
      systems.push_back(replies[b].system);
      bytes[b] = std::max<uint64_t>(bytes[b], PayloadBytes(systems.back()));
    }
    const std::optional<SeparatorSolution> solution =
        SolvePartitionedStep(path_.path, std::move(systems));
    if (!solution) {
      if (!WantsStep(path_.path.steps, PhaseBundle())) return EndPhase(false, replies.size());
      return AskAll(Request(Work::kLinearise), replies.size());
    }
    WorldRound round = AskAll(Request(Work::kTrial), replies.size());
    for (size_t b = 0; b < replies.size(); ++b)
      round.requests[b].step = solution->step_of_subproblem[b];
    return round;
  }

  WorldRound TakeTrial(std::span<const LmReply> replies) {
    std::vector<TrialCost> costs;
    for (const LmReply& reply : replies) costs.push_back(reply.trial);
    JudgePartitionedStep(path_.path, costs, PhaseBundle());
    const LevenbergMarquardt& steps = path_.path.steps;
    if (steps.accepted) path_.report.accepted_costs.back().push_back(steps.cost);
    BundleReport& report = path_.report.adjustments.back();
    report.final_cost = steps.cost;
    report.iterations = steps.iterations;
    report.converged = steps.converged;
    if (!WantsStep(steps, PhaseBundle())) return EndPhase(steps.accepted, replies.size());
    LmRequest request = Request(Work::kLinearise);
    request.takes_trial = steps.accepted;
    return AskAll(request, replies.size());
  }

  WorldRound EndPhase(bool takes_trial, size_t num_subproblems) {
    const bool is_last = path_.phase == options_.rounds;
    ++path_.phase;
    path_.is_done = is_last;
    path_.path.steps = {.control = StartLevenbergMarquardt(0.0, bundle_).control};
    LmRequest request = Request(Work::kFilter);
    request.takes_trial = takes_trial;
    request.evaluates_again = !is_last;
    return AskAll(request, num_subproblems);
  }

  void TakeFiltered(std::span<const LmReply> replies) {
    for (const LmReply& reply : replies) {
      path_.report.removed_observations += reply.removed_observations;
      path_.report.removed_tracks += reply.removed_tracks;
    }
  }

  WorldProgress path_;
  const GlobalAdjustOptions& options_;
  const BundleOptions& bundle_;
};

}  // namespace

WorldRound StartWorld(size_t num_subproblems,
                      const GlobalAdjustOptions& options,
                      const BundleOptions& bundle) {
  WorldProgress path{.path = {.steps = StartLevenbergMarquardt(0.0, bundle)}};
  const LmRequest request{.control = path.path.steps.control,
                          .loss = options.rounds == 0 ? BundleLoss::kLeastSquares : bundle.loss};
  return {std::move(path), std::vector<LmRequest>(num_subproblems, request)};
}

WorldRound AdvanceWorld(WorldProgress path,
                        std::span<const LmReply> replies,
                        const GlobalAdjustOptions& options,
                        const BundleOptions& bundle) {
  return Advancing(std::move(path), options, bundle).Take(replies);
}

}  // namespace orbweave
