// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/mapping/growth/grow_submodel.h"

namespace orbweave {

struct SubmodelResult {
  std::optional<MappingState> state{};  ///< absent: nothing could be started
  GrowthReport growth{};                ///< of all starts together
  bool started_globally = false;
  std::optional<bool> is_contested{};  ///< IsContested of the state, where it was asked
  std::string start_remark{};  ///< why not globally, or what speaks against it; empty: nothing
};

/// The largest model that can be grown among the available images.
///
/// With options.start not incremental all images at once come first (ReconstructGlobally). `auto`
/// takes that model when nothing speaks against it and it holds nearly all images that matches
/// reach; a sound one that is smaller still competes by its size. `global` takes any there is.
///
/// Else from the best seed pairs (FindSeedPairs), options.max_seeds at most; starts again elsewhere
/// when a seed does not hold or its model stays small against what its matches reach. Takes no
/// image twice as a failed seed. Where that leaves out images that matches reach, a model begun
/// with all of them is tried and taken when it is sound and larger.
[[nodiscard]] absl::StatusOr<SubmodelResult> ReconstructSubmodel(const ClusterProblem& problem,
                                                                 const CorrespondenceGraph& graph,
                                                                 std::span<const uint8_t> available,
                                                                 const MappingOptions& options,
                                                                 RegistrationLog& log,
                                                                 const StageContext& context);

}  // namespace orbweave
