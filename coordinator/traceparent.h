// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// The span that asked for something, in lower-case hexadecimal digits.
struct Traceparent {
  std::string trace_id{};   ///< 32 of them
  std::string parent_id{};  ///< 16
  bool is_sampled = true;   ///< whether its trace is kept
};

/// Reads `00-TRACE-PARENT-FLAGS`, and later versions as far as they are the same (W3C Trace
/// Context, 3.2). InvalidArgument: another form, or an id of zeros only.
[[nodiscard]] absl::StatusOr<Traceparent> ParseTraceparent(std::string_view text);

}  // namespace orbweave
