// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// What protects the bytes between a listener and its callers.
enum class Wire { kPlain, kEncrypted };

/// OK for "host:port", and for "unix:/path" on a plain wire. InvalidArgument for another form; for
/// any but a loopback host (127.x.x.x, localhost, [::1]) on a plain wire: what would be sent there
/// is neither encrypted nor authenticated; and for a socket that is to be encrypted.
[[nodiscard]] absl::Status CheckListenAddress(const std::string& address, Wire wire);

}  // namespace orbweave
