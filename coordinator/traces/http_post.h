// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "coordinator/traces/http_url.h"

namespace orbweave {

struct PostAnswer {
  int status = 0;
  std::string body{};  ///< of at most 64 KiB
};

/// Posts `body` over a connection of its own. Unavailable: nobody is there, or there is no answer
/// of HTTP within `timeout_s`. No redirection is followed. (A resolver of names that hangs may take
/// longer.)
[[nodiscard]] absl::StatusOr<PostAnswer> HttpPost(const HttpUrl& url,
                                                  std::string_view content_type,
                                                  std::string body,
                                                  double timeout_s);

}  // namespace orbweave
