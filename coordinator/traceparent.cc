// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traceparent.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr size_t kLength = 55;  ///< of version 00; later versions may have more behind a dash
constexpr size_t kMost = 256;

bool IsHex(std::string_view text) {
  return std::ranges::all_of(
      text, [](char c) { return absl::ascii_isdigit(c) || (c >= 'a' && c <= 'f'); });
}

bool IsId(std::string_view text) {
  return IsHex(text) && text.find_first_not_of('0') != std::string_view::npos;
}

bool HasItsLength(std::string_view text) {
  if (text.size() <= kLength || text.starts_with("00")) return text.size() == kLength;
  return text.size() <= kMost && text[kLength] == '-';
}

}  // namespace

absl::StatusOr<Traceparent> ParseTraceparent(std::string_view text) {
  if (HasItsLength(text) && text[2] == '-' && text[35] == '-' && text[52] == '-') {
    const std::string_view version = text.substr(0, 2);
    const std::string_view trace = text.substr(3, 32);
    const std::string_view parent = text.substr(36, 16);
    const std::string_view flags = text.substr(53, 2);
    if (IsHex(version) && version != "ff" && IsId(trace) && IsId(parent) && IsHex(flags)) {
      const bool is_sampled = std::string_view("13579bdf").find(flags[1]) != std::string_view::npos;
      return Traceparent{std::string(trace), std::string(parent), is_sampled};
    }
  }
  return absl::InvalidArgumentError(
      absl::StrCat("'",
                   absl::CHexEscape(std::string(text.substr(0, kMost))),
                   "' is no traceparent: it has the form 00-(32 hexadecimal digits)-(16)-(2)"));
}

}  // namespace orbweave
