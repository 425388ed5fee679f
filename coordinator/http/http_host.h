// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// Whether the Host header of a request names `listened_host` or the loopback: localhost, 127.0.0.1
/// or [::1], with any port or none. A page of a stranger that has its own name lead to this machine
/// (DNS rebinding) makes browsers send another.
[[nodiscard]] bool NamesThisHost(std::string_view host_header, std::string_view listened_host);

}  // namespace orbweave
