// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/auth_context.h>

#include <optional>
#include <string_view>

#include "core/base/status.h"
#include "security/identity.h"

namespace orbweave {

/// Who the certificate of a connection speaks for; nullopt when it showed none. PermissionDenied:
/// the certificate does not name exactly one identity.
[[nodiscard]] absl::StatusOr<std::optional<Identity>> PeerOf(const grpc::AuthContext& connection);

/// The same where there has to be one. Unauthenticated: there is none.
[[nodiscard]] absl::StatusOr<Identity> CertifiedPeerOf(const grpc::AuthContext& connection);

/// The certificate of a connection as PEM; empty when it showed none.
[[nodiscard]] std::string_view CertificateOf(const grpc::AuthContext& connection);

}  // namespace orbweave
