// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/adjust_blocks.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel_for.h"
#include "core/merging/steer_adjustment.h"
#include "core/merging/terms_of_block.h"

namespace orbweave {
namespace {

/// The same phases with the other solver, which takes no blocks.
absl::StatusOr<AdjustedBlocks> AdjustWithOracle(std::vector<WorldBlock> blocks,
                                                const GlobalAdjustOptions& options,
                                                BundleOptions bundle,
                                                const StageContext& context) {
  if (blocks.size() != 1) {
    return absl::InvalidArgumentError("bundle.solver=ceres adjusts one cluster, this model has " +
                                      std::to_string(blocks.size()) +
                                      ": add --single (partition.cluster_size=0)");
  }
  AdjustedBlocks adjusted;
  BlockWorker worker(std::move(blocks.front()), std::nullopt, BlockOptionsOf(options, bundle), 1);
  for (int phase = 0; phase <= options.rounds; ++phase) {
    if (phase == options.rounds) bundle.loss = BundleLoss::kLeastSquares;
    BundleProblem problem = TermsOf(worker.block()).problem;
    ORBWEAVE_ASSIGN_OR_RETURN(const BundleReport report, AdjustBundle(problem, bundle, context));
    BlockAnswer answer = worker.TakeOver(problem, report.biases_m);
    adjusted.report.adjustments.push_back(report);
    adjusted.report.removed_observations += answer.removed_observations;
    adjusted.report.removed_tracks += answer.removed_tracks;
    adjusted.summaries = {std::move(answer.summary)};
  }
  adjusted.blocks.push_back(worker.TakeBlock());
  return adjusted;
}

}  // namespace

absl::StatusOr<AdjustedBlocks> AdjustBlocks(std::vector<WorldBlock> blocks,
                                            const GlobalAdjustOptions& options,
                                            const BundleOptions& bundle,
                                            const StageContext& context) {
  if (bundle.solver == BundleSolver::kCeres) {
    return AdjustWithOracle(std::move(blocks), options, bundle, context);
  }
  std::vector<BlockWorker> workers;
  for (WorldBlock& block : blocks) {
    workers.emplace_back(std::move(block), std::nullopt, BlockOptionsOf(options, bundle), 1);
  }
  SteeredRound round = BeginAdjustment(workers.size(), options, bundle);
  AdjustedBlocks adjusted;
  while (!round.orders.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    std::vector<BlockAnswer> answers(workers.size());
    ParallelFor(workers.size(), context.num_threads, [&](size_t b) {
      answers[b] = workers[b].Execute(round.orders[b]);
    });
    round = SteerAdjustment(std::move(round.path), answers, options, bundle);
    context.Report(static_cast<uint64_t>(round.path.phase),
                   static_cast<uint64_t>(options.rounds) + 1,
                   "adjustments");
    if (!round.orders.empty()) continue;
    for (BlockAnswer& answer : answers) adjusted.summaries.push_back(std::move(answer.summary));
  }
  for (BlockWorker& worker : workers) adjusted.blocks.push_back(worker.TakeBlock());
  adjusted.report = std::move(round.path.report);
  return adjusted;
}

}  // namespace orbweave
