// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "core/base/status.h"
#include "stages/stage.h"

namespace orbweave {

/// Every stage of this build: what its workers can do.
[[nodiscard]] const std::vector<Stage>& AllStages();

/// NotFound: this build has no such stage.
[[nodiscard]] absl::StatusOr<const Stage*> FindStage(std::string_view name);

/// The same as whoever runs tasks asks for it (StageLookup).
[[nodiscard]] const StageFunction* FindStageFunction(std::string_view name);

}  // namespace orbweave
