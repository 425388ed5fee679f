// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace orbweave {

/// HMAC-SHA256 (RFC 2104) of `text` under `key`: 32 bytes.
[[nodiscard]] std::string HmacSha256(std::string_view key, std::string_view text);

}  // namespace orbweave
