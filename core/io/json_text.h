// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace orbweave {

/// Keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Readable text with a final line break. Names that are no UTF-8 get replacement characters
/// instead of an exception; NaN and infinity become null. `indent` < 0: one line.
[[nodiscard]] inline std::string JsonText(const Json& json, int indent = 1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orbweave
