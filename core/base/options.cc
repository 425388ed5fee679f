// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/options.h"

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace internal {

std::string DoubleToText(double value) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), end.ptr);
}

absl::StatusOr<double> DoubleFromText(std::string_view text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value)) {
    return absl::InvalidArgumentError("'" + std::string(text) + "' is not a number");
  }
  return value;
}

absl::StatusOr<int64_t> IntFromText(std::string_view text) {
  int32_t value = 0;  // what every whole option fits into: a larger one must not wrap
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) {
    return absl::InvalidArgumentError("'" + std::string(text) + "' is not a whole number");
  }
  return value;
}

absl::StatusOr<bool> BoolFromText(std::string_view text) {
  if (text == "true" || text == "1" || text == "yes" || text == "on") return true;
  if (text == "false" || text == "0" || text == "no" || text == "off") return false;
  return absl::InvalidArgumentError("'" + std::string(text) + "' is neither true nor false");
}

absl::Status CheckRange(std::string_view name, double value, Range range) {
  if (value >= range.low && value <= range.high) return absl::OkStatus();
  return absl::InvalidArgumentError(std::string(name) + "=" + DoubleToText(value) + " is outside " +
                                    RangeToText(range));
}

std::string RangeToText(Range range) {
  const auto end = [](double value) {
    if (std::isinf(value)) return std::string(value < 0 ? "-inf" : "inf");
    return DoubleToText(value);
  };
  return absl::StrCat("[", end(range.low), ", ", end(range.high), "]");
}

}  // namespace internal

namespace {

size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substitution, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string NearestName(std::string_view word, const std::vector<std::string>& candidates) {
  std::string nearest;
  size_t smallest = std::numeric_limits<size_t>::max();
  for (const std::string& candidate : candidates) {
    const size_t distance = EditDistance(word, candidate);
    if (distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace orbweave
