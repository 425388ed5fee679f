// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace orbweave {

/// One line to stderr, after the time of day (UTC). For services; thread-safe.
void LogLine(const std::string& line);

}  // namespace orbweave
