// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/scaling/engine_study.h"

namespace orbweave {

/// The sections of a page: what was run and what it does not tell, strong and weak efficiency,
/// where the slots' time went, bytes by link, the coordinator, and the simulator against each run.
[[nodiscard]] std::string EngineStudyHtml(const EngineStudy& study);

}  // namespace orbweave
