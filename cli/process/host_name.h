// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace orbweave {

/// This machine's own name.
[[nodiscard]] std::string HostName();

}  // namespace orbweave
