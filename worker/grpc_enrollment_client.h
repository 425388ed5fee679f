// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "security/tls_folder.h"

namespace orbweave {

/// Exchanges a join token for a certificate: a new key and what the coordinator at `address` gives
/// for it are written to `folder`, which is made when it is not there. The token goes nowhere but
/// to a coordinator that proves itself by the authority in the token. Unavailable: nobody answered,
/// the token is still good. PermissionDenied, FailedPrecondition: what the coordinator said.
[[nodiscard]] absl::Status Enroll(const std::string& address,
                                  const std::string& token,
                                  const std::string& name,
                                  const TlsFolder& folder);

/// Replaces the folder's certificate by a new one for the same key and identity.
[[nodiscard]] absl::Status RenewCertificate(const std::string& address, const TlsFolder& folder);

}  // namespace orbweave
