// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/scaling/engine_study.h"

namespace orbweave {

/// "strong" or "weak".
[[nodiscard]] std::string ScalingKindName(ScalingKind kind);

/// A cause of TimeShares by its name for people, in the order in which they are told.
[[nodiscard]] const std::vector<std::pair<std::string, double TimeShares::*>>& TimeCauses();

/// What a reader has to know before the numbers, a sentence each; plain text.
[[nodiscard]] std::vector<std::string> RemarksOn(const EngineStudy& study);

/// How the simulator did, in a sentence; plain text.
[[nodiscard]] std::string JudgeSimulator(const EngineStudy& study);

/// The study as tables in Markdown.
[[nodiscard]] std::string FormatEngineStudy(const EngineStudy& study);

}  // namespace orbweave
