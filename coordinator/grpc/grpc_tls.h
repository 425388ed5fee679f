// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "security/revocations.h"
#include "security/tls_folder.h"

namespace orbweave {

/// What callers without a certificate meet.
enum class Strangers {
  kRefused,     ///< the handshake fails
  kLetToEnrol,  ///< GrpcGate decides
};

/// Credentials of a listener: its certificate and authorities come from `folder`, and again when
/// the files change; every call passes a GrpcGate, which asks `revocations`. InvalidArgument: the
/// folder is not a coordinator's; else as CheckTlsFolder.
[[nodiscard]] absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeTlsCredentials(
    const TlsFolder& folder, Strangers strangers, std::shared_ptr<RevocationList> revocations);

}  // namespace orbweave
