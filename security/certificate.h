// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "security/identity.h"

namespace orbweave {

struct CertificateFacts {
  Identity identity{};
  std::string serial{};  ///< upper-case hexadecimal digits, as `openssl x509 -serial` prints them
  int64_t begins_unix_s = 0;
  int64_t ends_unix_s = 0;
};

/// What the first certificate of a PEM text says; its signature is not looked at. InvalidArgument:
/// no certificate, or not exactly one identity in it.
[[nodiscard]] absl::StatusOr<CertificateFacts> ReadCertificate(std::string_view pem);

}  // namespace orbweave
