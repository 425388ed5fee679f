// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/digest.h"
#include "core/merging/finalise_adjustment.h"
#include "core/merging/join_submodels.h"
#include "core/partitioned_ba/advance_world.h"

/// What the stages of the distributed global adjustment hand on. Bulk is named by digest.

namespace orbweave {

/// All that one subproblem is put together from.
struct AssembleRecipe {
  JoinedSubproblem joined{};
  Digest cluster_result{};
  std::vector<ImageId> shared{};  ///< images of the cluster that other clusters have too, sorted
};

/// One piece of work for one subproblem.
struct SubproblemTask {
  Digest subproblem{};
  Digest state{};  ///< zero: none yet
  LmRequest request{};
};

struct SubproblemResult {
  LmReply reply{};
  Digest subproblem{};  ///< zero: as it was
  Digest state{};       ///< zero: none
  /// Of the last request alone: what the adjusted subproblem has to say about its world.
  Digest inspection{};
};

/// A subproblem's place in the adjustment and where it stands.
struct SubproblemPlace {
  uint32_t world = 0;
  Digest subproblem{};
  Digest state{};               ///< the one that counts
  Digest trial{};               ///< where the last step led
  SubproblemSummary summary{};  ///< of a world that is done ...
  Digest inspection{};          ///< ... too: a SubproblemInspection
};

/// What is known between two rounds.
struct AdjustmentProgress {
  std::vector<WorldProgress> worlds{};
  std::vector<uint8_t> is_asked{};             ///< per world: its subproblems are at work
  std::vector<SubproblemPlace> subproblems{};  ///< sorted by (world, cluster)
};

/// The result of the sparse line, without its tracks: those are in the subproblems.
struct FinalisedModel {
  std::vector<FinalisedWorld> worlds{};            ///< most images first
  std::vector<std::vector<Digest>> subproblems{};  ///< per world: Subproblems
  std::vector<Exclusion> left_out{};  ///< images of worlds of which none is left, and why
};

}  // namespace orbweave
