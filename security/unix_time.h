// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ctime>
#include <functional>

namespace orbweave {

/// Seconds since 1970: what certificates and tokens end by. Nothing else reads the calendar.
using UnixClock = std::function<int64_t()>;

[[nodiscard]] inline int64_t UnixNow() { return static_cast<int64_t>(std::time(nullptr)); }

}  // namespace orbweave
