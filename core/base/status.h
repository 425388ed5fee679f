// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

/// Errors of the house: `absl::Status` for what can go wrong outside the program, ORBWEAVE_CHECK
/// for a promise that the code itself broke.

namespace orbweave {

/// The same status with "`context`: " before its message (payloads are not kept).
[[nodiscard]] absl::Status Annotate(const absl::Status& status, std::string_view context);

namespace internal {
[[noreturn]] void CheckFailed(const char* condition, const char* file, int line);
inline absl::Status StatusOf(absl::Status status) { return status; }
template <typename T>
absl::Status StatusOf(const absl::StatusOr<T>& value) {
  return value.status();
}
}  // namespace internal
}  // namespace orbweave

#define ORBWEAVE_CONCAT_INNER(a, b) a##b
#define ORBWEAVE_CONCAT(a, b) ORBWEAVE_CONCAT_INNER(a, b)

/// Aborts with the condition and the place when a promise of the code is broken.
#define ORBWEAVE_CHECK(condition)                                        \
  do {                                                                   \
    if (!(condition)) {                                                  \
      ::orbweave::internal::CheckFailed(#condition, __FILE__, __LINE__); \
    }                                                                    \
  } while (false)

/// Leaves the function with the status of `expression` unless it is OK.
#define ORBWEAVE_RETURN_IF_ERROR(expression)                                  \
  do {                                                                        \
    if (absl::Status orbweave_status = (expression); !orbweave_status.ok()) { \
      return orbweave_status;                                                 \
    }                                                                         \
  } while (false)

/// `ORBWEAVE_ASSIGN_OR_RETURN(auto x, F())`: x is the value of F(), or the function returns its
/// status.
#define ORBWEAVE_ASSIGN_OR_RETURN(declaration, expression) \
  ORBWEAVE_ASSIGN_OR_RETURN_INNER(                         \
      ORBWEAVE_CONCAT(orbweave_value_, __LINE__), declaration, expression)
#define ORBWEAVE_ASSIGN_OR_RETURN_INNER(temporary, declaration, expression) \
  auto temporary = (expression);                                            \
  if (!temporary.ok()) {                                                    \
    return ::orbweave::internal::StatusOf(temporary);                       \
  }                                                                         \
  declaration = std::move(temporary).value()
