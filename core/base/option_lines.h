// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// "section.key=value", without the blanks around name and value.
struct OptionAssignment {
  std::string name{};  ///< "section.key"
  std::string value{};

  [[nodiscard]] std::string_view section() const;  ///< before the first dot; all without one
  [[nodiscard]] std::string_view key() const;      ///< after it; empty without one
};

/// InvalidArgument: no '='.
[[nodiscard]] absl::StatusOr<OptionAssignment> ParseOptionAssignment(std::string_view text);

/// Gives every line of `text` to `set`, but for blank ones and those that begin with '#'. Ends with
/// the first error, annotated with `source` and the line.
[[nodiscard]] absl::Status ForEachOptionLine(
    std::string_view text,
    std::string_view source,
    const std::function<absl::Status(std::string_view line)>& set);

}  // namespace orbweave
