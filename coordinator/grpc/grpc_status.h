// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include "core/base/status.h"

/// Leaves a handler with the status of `expression` unless it is OK.
#define ORBWEAVE_GRPC_RETURN_IF_ERROR(expression)                                   \
  do {                                                                              \
    if (const absl::Status orbweave_status = (expression); !orbweave_status.ok()) { \
      return ::orbweave::OnWire(orbweave_status);                                   \
    }                                                                               \
  } while (false)
#define ORBWEAVE_GRPC_ASSIGN_OR_RETURN(declaration, expression) \
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN_INNER(                         \
      ORBWEAVE_CONCAT(orbweave_value_, __LINE__), declaration, expression)
#define ORBWEAVE_GRPC_ASSIGN_OR_RETURN_INNER(temporary, declaration, expression) \
  auto temporary = (expression);                                                 \
  if (!temporary.ok()) return ::orbweave::OnWire(temporary.status());            \
  declaration = std::move(temporary).value()

namespace orbweave {

/// The codes of absl::Status and gRPC are the same numbers; a text that would not fit into a header
/// is cut.
[[nodiscard]] inline grpc::Status OnWire(const absl::Status& status) {
  constexpr size_t kMaxErrorBytes = 4000;  // gRPC's limit for all headers is 8 KiB
  if (status.ok()) return grpc::Status::OK;
  return {static_cast<grpc::StatusCode>(status.code()),
          std::string(status.message().substr(0, kMaxErrorBytes))};
}

}  // namespace orbweave
