// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/option_lines.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace orbweave {
namespace {

std::string Trimmed(std::string_view text) {
  return std::string(absl::StripAsciiWhitespace(std::string(text)));
}

}  // namespace

std::string_view OptionAssignment::section() const {
  return std::string_view(name).substr(0, name.find('.'));
}

std::string_view OptionAssignment::key() const {
  return std::string_view(name).substr(std::min(name.size(), section().size() + 1));
}

absl::StatusOr<OptionAssignment> ParseOptionAssignment(std::string_view text) {
  const size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    return absl::InvalidArgumentError("'" + std::string(text) +
                                      "' is not of the form section.key=value");
  }
  return OptionAssignment{.name = Trimmed(text.substr(0, equals)),
                          .value = Trimmed(text.substr(equals + 1))};
}

absl::Status ForEachOptionLine(std::string_view text,
                               std::string_view source,
                               const std::function<absl::Status(std::string_view line)>& set) {
  int line_number = 0;
  for (const absl::string_view raw :
       absl::StrSplit(absl::string_view(text.data(), text.size()), '\n')) {
    ++line_number;
    const absl::string_view line = absl::StripAsciiWhitespace(raw);
    if (line.empty() || line.front() == '#') continue;
    ORBWEAVE_RETURN_IF_ERROR(Annotate(set(std::string_view(line.data(), line.size())),
                                      absl::StrCat(std::string(source), " line ", line_number)));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
