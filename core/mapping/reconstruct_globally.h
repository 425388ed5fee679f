// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/mapping/growth/grow_submodel.h"

namespace orbweave {

struct GlobalModel {
  std::optional<MappingState> state{};  ///< absent: nothing could be started
  GrowthReport growth{};
  std::string fault{};  ///< why the model is absent or not to be trusted; empty for a sound one
};

/// Where all images begin at once.
enum class GlobalStart {
  kPairs,      ///< StartGlobally
  kPositions,  ///< StartOnPositions
};

/// A model of the available images begun with all of them at once, grown like any other
/// (GrowSubmodel), then checked against the pairs (CheckAgainstPairs). Cancelled when asked to
/// stop.
[[nodiscard]] absl::StatusOr<GlobalModel> ReconstructGlobally(const ClusterProblem& problem,
                                                              const CorrespondenceGraph& graph,
                                                              std::span<const uint8_t> available,
                                                              GlobalStart start,
                                                              const MappingOptions& options,
                                                              RegistrationLog& log,
                                                              const StageContext& context);

}  // namespace orbweave
