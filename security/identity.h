// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

enum class Role : uint8_t { kCoordinator, kWorker, kClient, kAdmin };

/// "coordinator", "worker", "client", "admin".
[[nodiscard]] std::string_view RoleName(Role role);
[[nodiscard]] absl::StatusOr<Role> RoleFromName(std::string_view name);

/// Who a certificate speaks for. It is the certificate's only subject alternative name of the form
/// orbweave://FLEET/ROLE/NAME.
struct Identity {
  std::string fleet{};
  Role role = Role::kWorker;
  std::string name{};

  friend bool operator==(const Identity&, const Identity&) = default;

  [[nodiscard]] std::string ToUri() const;
  /// InvalidArgument unless `uri` has that form and CheckName holds for both names.
  [[nodiscard]] static absl::StatusOr<Identity> FromUri(std::string_view uri);
};

inline constexpr std::string_view kIdentityScheme = "orbweave://";

/// OK for 1 to 100 letters, digits, '.', '_' and '-', the first a letter or digit: a name that is
/// safe in a URI, in a file name and in a log.
[[nodiscard]] absl::Status CheckName(std::string_view name);

/// Whether the holder of this identity may call a worker `worker_name`: its own name, or its own
/// name, '/' and another name (several workers with one certificate). An admin may take any.
[[nodiscard]] bool MaySpeakFor(const Identity& identity, std::string_view worker_name);

}  // namespace orbweave
