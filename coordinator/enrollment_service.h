// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "coordinator/used_tokens.h"
#include "core/pipeline/log_event.h"
#include "security/certificate_authority.h"
#include "security/revocations.h"
#include "security/tls_folder.h"
#include "security/unix_time.h"

namespace orbweave {

struct EnrollmentOptions {
  TlsFolder tls{};              ///< the coordinator's, with the authority's key and the token key
  std::string used_folder{};    ///< where used tokens are remembered
  int64_t valid_s = 24 * 3600;  ///< of the certificates it gives
  UnixClock now_unix_s = UnixNow;
  EventLog log{};  ///< told of every certificate
};

/// Gives certificates to workers: the first for a join token, the next ones for the one before.
/// Thread-safe.
class EnrollmentService {
 public:
  /// Errors: of the folder's files; InvalidArgument: they do not belong together.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<EnrollmentService>> Open(
      const EnrollmentOptions& options);

  /// A certificate for the key of `request_pem`, as often as the token says. The worker is called
  /// `name`, the first digits of the token's nonce and, of one for several, the number of this use:
  /// no token takes the name of another worker, and no two workers have one name.
  /// PermissionDenied: the token is false, expired, revoked, used, or of another fleet.
  /// InvalidArgument: a bad name or request; the token is then still good.
  [[nodiscard]] absl::StatusOr<std::string> Enroll(const std::string& token,
                                                   const std::string& request_pem,
                                                   const std::string& name);

  /// A certificate that says of the key of `request_pem` what the present one says of `peer`.
  [[nodiscard]] absl::StatusOr<std::string> Renew(const Identity& peer,
                                                  const std::string& request_pem) const;

 private:
  EnrollmentService(EnrollmentOptions options,
                    CertificateAuthority authority,
                    std::string token_key,
                    std::shared_ptr<RevocationList> revocations,
                    UsedTokens used)
      : options_(std::move(options)),
        authority_(std::move(authority)),
        token_key_(std::move(token_key)),
        revocations_(std::move(revocations)),
        used_(std::move(used)) {}

  EnrollmentOptions options_;
  CertificateAuthority authority_;
  std::string token_key_;
  std::shared_ptr<RevocationList> revocations_;
  UsedTokens used_;
};

}  // namespace orbweave
