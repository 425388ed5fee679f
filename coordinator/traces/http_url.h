// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

struct HttpUrl {
  std::string host{};  ///< an IPv6 address without its brackets
  std::string port{};
  std::string target = "/";  ///< path and query

  /// "host:port", as a Host header has it.
  [[nodiscard]] std::string Authority() const;
  [[nodiscard]] std::string ToText() const;
};

/// Reads http://HOST[:PORT][/PATH]. InvalidArgument: another form, a user or password in it, or
/// https, which HttpPost does not speak.
[[nodiscard]] absl::StatusOr<HttpUrl> ParseHttpUrl(std::string_view text);

}  // namespace orbweave
