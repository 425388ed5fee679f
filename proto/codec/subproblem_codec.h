// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/base/status.h"
#include "core/partitioned_ba/subproblem_eliminator.h"

/// Subproblems of the global adjustment and their states. Decoders: DataLoss for arrays
/// that do not match, numbers that are none, and terms of what is not there.

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeSubproblem(const Subproblem& subproblem);
[[nodiscard]] absl::StatusOr<Subproblem> DecodeSubproblem(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeAssembleRecipe(const AssembleRecipe& recipe);
[[nodiscard]] absl::StatusOr<AssembleRecipe> DecodeAssembleRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeJoinedWorlds(
    const std::vector<JoinedWorld>& worlds);
[[nodiscard]] absl::StatusOr<std::vector<JoinedWorld>> DecodeJoinedWorlds(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeSubproblemState(const EvaluatedState& state);
[[nodiscard]] absl::StatusOr<EvaluatedState> DecodeSubproblemState(std::string_view bytes);

}  // namespace orbweave
