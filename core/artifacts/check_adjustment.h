// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/base/status.h"

namespace orbweave {

/// The same as check_bounds.h for what passes between the rounds of the global adjustment: DataLoss
/// says what does not fit, and nothing is computed with it.

/// A state is of the subproblem: as many poses, points and biases as that has.
[[nodiscard]] absl::Status CheckState(const Subproblem& subproblem, const EvaluatedState& state);

/// A request is to the subproblem: a step is of its separators; beyond the first it has a state.
[[nodiscard]] absl::Status CheckRequest(const Subproblem& subproblem,
                                        const LmRequest& request,
                                        bool has_state);

/// Replies of all subproblems of a world are to what it asked.
[[nodiscard]] absl::Status CheckReplies(const WorldProgress& world,
                                        std::span<const SubproblemResult> results,
                                        const GlobalAdjustOptions& options);

/// An adjustment that is over is of these worlds.
[[nodiscard]] absl::Status CheckFinished(const AdjustmentProgress& progress,
                                         const std::vector<JoinedWorld>& worlds);

/// What subproblems say of their world is about its images and drives.
[[nodiscard]] absl::Status CheckAdjustedWorld(const AdjustedWorld& adjusted,
                                              const Georeference& georeference,
                                              const ImageManifest& manifest);

}  // namespace orbweave
