// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "security/identity.h"
#include "security/openssl_handles.h"

namespace orbweave {

/// A certificate and the private key of its holder, as PEM. The key is a secret.
struct CertifiedKey {
  std::string certificate_pem{};
  std::string key_pem{};
};

/// What a certificate is to say.
struct CertificateOrder {
  Identity identity{};
  std::vector<std::string> hosts{};  ///< DNS names and IP addresses a coordinator is reached by
  int64_t now_unix_s = 0;
  int64_t valid_s = 0;
};

/// A fleet's certificate authority. A certificate of a coordinator serves a listener, one of any
/// other role serves a caller, never both. Thread-safe.
class CertificateAuthority {
 public:
  /// A new authority that signs itself. InvalidArgument: CheckName refuses the fleet's name.
  [[nodiscard]] static absl::StatusOr<CertifiedKey> Make(const std::string& fleet,
                                                         int64_t now_unix_s,
                                                         int64_t valid_s);
  /// InvalidArgument: not an authority made by Make, or the key of another certificate.
  [[nodiscard]] static absl::StatusOr<CertificateAuthority> Load(const CertifiedKey& own);

  /// Certifies the public key of `request_pem` (PEM of PKCS #10) as `order` says; whatever else the
  /// request asks for is ignored. It is valid from five minutes before `now_unix_s`, for clocks
  /// that are late. InvalidArgument: a bad request, another fleet, a bad host.
  [[nodiscard]] absl::StatusOr<std::string> Issue(std::string_view request_pem,
                                                  const CertificateOrder& order) const;

  [[nodiscard]] const std::string& fleet() const { return fleet_; }
  [[nodiscard]] const std::string& certificate_pem() const { return certificate_pem_; }

 private:
  std::string fleet_;
  std::string certificate_pem_;
  CertificateHandle certificate_;
  KeyHandle key_;
};

}  // namespace orbweave
