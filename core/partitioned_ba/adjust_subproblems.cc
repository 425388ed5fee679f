// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/adjust_subproblems.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel_for.h"
#include "core/bundle/adjust_bundle.h"
#include "core/partitioned_ba/advance_world.h"
#include "core/partitioned_ba/terms_of_subproblem.h"

namespace orbweave {
namespace {

/// The same phases with the other solver, which takes no subproblems.
absl::StatusOr<AdjustedSubproblems> AdjustWithOracle(std::vector<Subproblem> subproblems,
                                                     const GlobalAdjustOptions& options,
                                                     BundleOptions bundle,
                                                     const StageContext& context) {
  if (subproblems.size() != 1) {
    return absl::InvalidArgumentError("bundle.solver=ceres adjusts one cluster, this model has " +
                                      std::to_string(subproblems.size()) +
                                      ": add --single (partition.cluster_size=0)");
  }
  AdjustedSubproblems adjusted;
  SubproblemSolver worker(
      std::move(subproblems.front()), std::nullopt, SubproblemOptionsOf(options, bundle), 1);
  for (int phase = 0; phase <= options.rounds; ++phase) {
    if (phase == options.rounds) bundle.loss = BundleLoss::kLeastSquares;
    BundleProblem problem = TermsOf(worker.subproblem()).problem;
    ORBWEAVE_ASSIGN_OR_RETURN(const BundleReport report, AdjustBundle(problem, bundle, context));
    LmReply reply = worker.TakeOver(problem, report.biases_m);
    adjusted.report.adjustments.push_back(report);
    adjusted.report.removed_observations += reply.removed_observations;
    adjusted.report.removed_tracks += reply.removed_tracks;
    adjusted.summaries = {std::move(reply.summary)};
  }
  adjusted.subproblems.push_back(worker.TakeSubproblem());
  return adjusted;
}

}  // namespace

absl::StatusOr<AdjustedSubproblems> AdjustSubproblems(std::vector<Subproblem> subproblems,
                                                      const GlobalAdjustOptions& options,
                                                      const BundleOptions& bundle,
                                                      const StageContext& context) {
  if (bundle.solver == BundleSolver::kCeres) {
    return AdjustWithOracle(std::move(subproblems), options, bundle, context);
  }
  std::vector<SubproblemSolver> workers;
  for (Subproblem& subproblem : subproblems) {
    workers.emplace_back(
        std::move(subproblem), std::nullopt, SubproblemOptionsOf(options, bundle), 1);
  }
  WorldRound round = StartWorld(workers.size(), options, bundle);
  AdjustedSubproblems adjusted;
  while (!round.requests.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    std::vector<LmReply> replies(workers.size());
    ParallelFor(workers.size(), context.num_threads, [&](size_t b) {
      replies[b] = workers[b].Execute(round.requests[b]);
    });
    round = AdvanceWorld(std::move(round.path), replies, options, bundle);
    context.Report(static_cast<uint64_t>(round.path.phase),
                   static_cast<uint64_t>(options.rounds) + 1,
                   "adjustments");
    if (!round.requests.empty()) continue;
    for (LmReply& reply : replies) adjusted.summaries.push_back(std::move(reply.summary));
  }
  for (SubproblemSolver& worker : workers) adjusted.subproblems.push_back(worker.TakeSubproblem());
  adjusted.report = std::move(round.path.report);
  return adjusted;
}

}  // namespace orbweave
