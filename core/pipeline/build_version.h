// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// The version of this build, e.g. "0.1.0". A coordinator takes workers of its own version alone.
[[nodiscard]] std::string_view BuildVersion();

}  // namespace orbweave
