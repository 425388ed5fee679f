// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/schur_adjuster.h"

#include <utility>

#include "core/bundle/bundle_eliminator.h"
#include "core/bundle/gauge.h"
#include "core/bundle/levenberg_marquardt.h"

namespace orbweave {
namespace {

LevenbergMarquardt TakeStep(const LevenbergMarquardt& path,
                            const BundleOptions& options,
                            BundleEliminator& eliminator,
                            EvaluatedState& state,
                            EvaluatedState& trial) {
  if (!eliminator.Linearise(state, path.control)) return AfterFailure(path);
  const TrialCost cost = eliminator.BackSubstitute(state, {}, trial);
  const LevenbergMarquardt next = AfterTrial(path, cost.cost, cost.predicted_decrease, options);
  if (next.accepted) std::swap(state, trial);
  return next;
}

}  // namespace

absl::StatusOr<BundleReport> AdjustBundleWithSchur(BundleProblem& problem,
                                                   const BundleOptions& options,
                                                   const StageContext& context) {
  const Gauge gauge = ChooseGauge(problem);
  const double distance = HeldDistance(gauge, problem);
  BundleEliminator eliminator(problem, gauge, {}, options, context.num_threads);
  EvaluatedState state = eliminator.Start();
  EvaluatedState trial;
  LevenbergMarquardt path = StartLevenbergMarquardt(eliminator.Cost(state), options);
  BundleReport report{.initial_cost = path.cost};
  absl::Status status;
  while (WantsStep(path, options) && (status = context.CheckStop()).ok()) {
    path = TakeStep(path, options, eliminator, state, trial);
  }
  WriteBack(eliminator.layout(), state.variables, problem);
  RestoreScale(gauge, distance, problem);
  ORBWEAVE_RETURN_IF_ERROR(status);
  report.final_cost = path.cost;
  report.iterations = path.iterations;
  report.converged = path.converged;
  report.biases_m = state.variables.biases;
  return report;
}

}  // namespace orbweave
