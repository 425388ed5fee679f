// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/scene/cross_check.h"

namespace orbweave {

/// "good", "doubtful" or "bad".
[[nodiscard]] inline std::string LevelText(CheckLevel level) {
  for (const auto& [value, name] : EnumNames<CheckLevel>::kNames) {
    if (value == level) return std::string(name);
  }
  return "unknown";
}

/// "at_most" or "at_least".
[[nodiscard]] inline std::string BoundText(CheckBound bound) {
  return bound == CheckBound::kAtMost ? "at_most" : "at_least";
}

}  // namespace orbweave
