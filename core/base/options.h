// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/status.h"

/// Options with reflection. An algorithm's options are one aggregate beside its function:
///
///   struct MatchOptions {
///     double max_ratio = 0.8;
///     template <typename Self, typename Visitor>
///     static void VisitFields(Self& self, Visitor&& visit) {
///       visit("max_ratio", self.max_ratio, "best over second-best distance", Range{0.1, 1.0});
///     }
///   };
///
/// Default initialisers are the defaults. From the one visit line per field follow validation,
/// help, config files, `--set section.key=value`, and the canonical text that names a task.

namespace orbweave {

/// Closed interval that a numeric option must lie in.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Specialise for an enumeration used as an option:
///   static constexpr std::array<std::pair<Preset, std::string_view>, 2> kNames = {{...}};
template <typename E>
struct EnumNames;

struct OptionInfo {
  std::string name{};
  std::string value{};
  std::string help{};
  std::string range{};
};

namespace internal {

std::string DoubleToText(double value);
absl::StatusOr<double> DoubleFromText(std::string_view text);
absl::StatusOr<int64_t> IntFromText(std::string_view text);
absl::StatusOr<bool> BoolFromText(std::string_view text);
absl::Status CheckRange(std::string_view name, double value, Range range);
std::string RangeToText(Range range);

template <typename T>
std::string ValueToText(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    for (const auto& [e, name] : EnumNames<T>::kNames) {
      if (e == value) return std::string(name);
    }
    return "?";
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return DoubleToText(value);
  } else {
    return value;
  }
}

template <typename T>
absl::Status ValueFromText(std::string_view text, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    ORBWEAVE_ASSIGN_OR_RETURN(value, BoolFromText(text));
  } else if constexpr (std::is_enum_v<T>) {
    std::string known;
    for (const auto& [e, name] : EnumNames<T>::kNames) {
      if (name == text) {
        value = e;
        return absl::OkStatus();
      }
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    return absl::InvalidArgumentError("'" + std::string(text) + "' is none of: " + known);
  } else if constexpr (std::is_integral_v<T>) {
    ORBWEAVE_ASSIGN_OR_RETURN(const int64_t parsed, IntFromText(text));
    value = static_cast<T>(parsed);
  } else if constexpr (std::is_floating_point_v<T>) {
    ORBWEAVE_ASSIGN_OR_RETURN(value, DoubleFromText(text));
  } else {
    value = std::string(text);
  }
  return absl::OkStatus();
}

template <typename T>
std::string RangeOf(const T&, Range range) {
  if constexpr (std::is_same_v<T, bool>) {
    return "true|false";
  } else if constexpr (std::is_enum_v<T>) {
    std::string names;
    for (const auto& [e, name] : EnumNames<T>::kNames) {
      names += (names.empty() ? "" : "|") + std::string(name);
    }
    return names;
  } else if constexpr (std::is_arithmetic_v<T>) {
    return RangeToText(range);
  } else {
    return "text";
  }
}

/// Visits every field as visit(name, member, help, Range), supplying an open range where none is
/// given.
template <typename Options, typename Visitor>
void ForEachField(Options& options, Visitor&& visit) {
  std::remove_const_t<Options>::VisitFields(
      options, [&](std::string_view name, auto& member, std::string_view help, Range range = {}) {
        visit(name, member, help, range);
      });
}

}  // namespace internal

/// "section.key=value" lines in field order; equal options give equal text.
template <typename Options>
std::string OptionsToText(std::string_view section, const Options& options) {
  std::string text;
  internal::ForEachField(options,
                         [&](std::string_view name, const auto& member, std::string_view, Range) {
                           text += std::string(section) + "." + std::string(name) + "=" +
                                   internal::ValueToText(member) + "\n";
                         });
  return text;
}

/// Every field with its value, help and range.
template <typename Options>
std::vector<OptionInfo> DescribeOptions(std::string_view section, const Options& options) {
  std::vector<OptionInfo> infos;
  internal::ForEachField(
      options, [&](std::string_view name, const auto& member, std::string_view help, Range range) {
        infos.push_back({std::string(section) + "." + std::string(name),
                         internal::ValueToText(member),
                         std::string(help),
                         internal::RangeOf(member, range)});
      });
  return infos;
}

/// Sets one field from text. NotFound when there is no such field, InvalidArgument when the text
/// does not fit its type or range.
template <typename Options>
absl::Status SetOption(Options& options, std::string_view key, std::string_view text) {
  absl::Status status = absl::NotFoundError("no option '" + std::string(key) + "'");
  internal::ForEachField(
      options, [&](std::string_view name, auto& member, std::string_view, Range range) {
        if (name != key) return;
        auto parsed = member;
        status = internal::ValueFromText(text, parsed);
        if constexpr (std::is_arithmetic_v<decltype(parsed)> &&
                      !std::is_same_v<decltype(parsed), bool>) {
          if (status.ok()) status = internal::CheckRange(name, static_cast<double>(parsed), range);
        }
        if (status.ok()) member = parsed;
      });
  return status;
}

/// InvalidArgument naming the first field outside its range.
template <typename Options>
absl::Status ValidateOptions(std::string_view section, const Options& options) {
  absl::Status status;
  internal::ForEachField(
      options, [&](std::string_view name, const auto& member, std::string_view, Range range) {
        using T = std::remove_cvref_t<decltype(member)>;
        if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
          if (status.ok()) {
            status = internal::CheckRange(
                std::string(section) + "." + std::string(name), static_cast<double>(member), range);
          }
        }
      });
  return status;
}

/// The candidate with the smallest edit distance to `word` (empty when there are none): for "did
/// you mean".
[[nodiscard]] std::string NearestName(std::string_view word,
                                      const std::vector<std::string>& candidates);

}  // namespace orbweave
