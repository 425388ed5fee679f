// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// A new private key (P-256) as PEM: a secret.
[[nodiscard]] absl::StatusOr<std::string> MakePrivateKey();

/// A request, signed by the key, to certify the key's public half: PEM of PKCS #10. It names
/// nobody; who it is for is decided by the one who certifies. InvalidArgument: no key.
[[nodiscard]] absl::StatusOr<std::string> MakeCertificateRequest(std::string_view key_pem);

}  // namespace orbweave
