// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/status.h"
#include "core/distributed_bundle/block_solver.h"
#include "core/stages/adjustment_records.h"

/// Blocks of the global adjustment and their states. Decoders: DataLoss or InvalidArgument for
/// arrays that do not match.

namespace orbweave {

[[nodiscard]] std::string EncodeWorldBlock(const WorldBlock& block);
[[nodiscard]] absl::StatusOr<WorldBlock> DecodeWorldBlock(std::string_view bytes);

[[nodiscard]] std::string EncodeAssembleRecipe(const AssembleRecipe& recipe);
[[nodiscard]] absl::StatusOr<AssembleRecipe> DecodeAssembleRecipe(std::string_view bytes);

[[nodiscard]] std::string EncodeJoinedWorlds(const std::vector<JoinedWorld>& worlds);
[[nodiscard]] absl::StatusOr<std::vector<JoinedWorld>> DecodeJoinedWorlds(std::string_view bytes);

[[nodiscard]] std::string EncodeBlockState(const EvaluatedState& state);
[[nodiscard]] absl::StatusOr<EvaluatedState> DecodeBlockState(std::string_view bytes);

}  // namespace orbweave
