// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_globally.h"

#include "core/mapping/check_against_pairs.h"
#include "core/mapping/start_globally.h"

namespace orbweave {

absl::StatusOr<GlobalModel> ReconstructGlobally(const ClusterProblem& problem,
                                                const CorrespondenceGraph& graph,
                                                std::span<const uint8_t> available,
                                                const MappingOptions& options,
                                                RegistrationLog& log,
                                                const StageContext& context) {
  GlobalModel model;
  MappingState state(problem, graph);
  ORBWEAVE_ASSIGN_OR_RETURN(const bool started, StartGlobally(state, available, options, context));
  if (!started) {
    model.fault = "pairs place " + std::to_string(state.Registered().size()) + " images only";
    return model;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(model.growth, GrowSubmodel(state, available, options, log, context));
  model.fault = FaultOf(CheckAgainstPairs(state, options));
  model.state.emplace(std::move(state));
  return model;
}

}  // namespace orbweave
