// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/base/status.h"
#include "security/identity.h"

namespace orbweave {

/// Who may call one method of the services.
struct MethodRight {
  std::string_view method{};  ///< as on the wire: "/orbweave.v1.Coordinator/Join"
  bool worker = false;
  bool client = false;
  bool stranger = false;  ///< even without a certificate
};

/// One row per method. An admin may call every one of them.
[[nodiscard]] std::span<const MethodRight> MethodRights();

/// OK when `peer` (nullopt: it showed no certificate) may call `method` on a coordinator of
/// `fleet`. Unauthenticated: a certificate is needed. PermissionDenied: of another fleet, or
/// not a matter of its role; so is every method without a row.
[[nodiscard]] absl::Status CheckRight(std::string_view method,
                                      const std::optional<Identity>& peer,
                                      std::string_view fleet);

}  // namespace orbweave
