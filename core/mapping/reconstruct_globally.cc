// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_globally.h"

#include "core/mapping/adjustment/level_cameras.h"
#include "core/mapping/checks/check_against_pairs.h"
#include "core/mapping/growth/start_globally.h"

namespace orbweave {

absl::StatusOr<GlobalModel> ReconstructGlobally(const ClusterProblem& problem,
                                                const CorrespondenceGraph& graph,
                                                std::span<const uint8_t> available,
                                                GlobalStart start,
                                                const MappingOptions& options,
                                                RegistrationLog& log,
                                                const StageContext& context) {
  GlobalModel model;
  MappingState state = LevelState(problem, graph, options);
  const auto begin = start == GlobalStart::kPairs ? StartGlobally : StartOnPositions;
  ORBWEAVE_ASSIGN_OR_RETURN(const bool started, begin(state, available, options, context));
  if (!started) {
    const std::string who = start == GlobalStart::kPairs ? "pairs" : "positions";
    model.fault = who + " place " + std::to_string(state.Registered().size()) + " images only";
    return model;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(model.growth, GrowSubmodel(state, available, options, log, context));
  const PairCheck check = CheckAgainstPairs(state, options);
  // Where houses repeat many pairs do not agree with a right model either.
  model.fault = start == GlobalStart::kPairs ? FaultOf(check) : TearOf(check);
  model.state.emplace(std::move(state));
  return model;
}

}  // namespace orbweave
