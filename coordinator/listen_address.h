// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// OK for "unix:/path" and for "host:port" on a loopback host (127.x.x.x, localhost, [::1]).
/// InvalidArgument for another form, and for every other host: what would be sent there is neither
/// encrypted nor authenticated.
[[nodiscard]] absl::Status CheckListenAddress(const std::string& address);

}  // namespace orbweave
