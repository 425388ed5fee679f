// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/enrollment_service.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/open_revocations.h"
#include "security/join_token.h"
#include "security/secret_file.h"

namespace orbweave {
namespace {

/// The worker that uses a token for the `use`th time.
Identity BearerOf(const JoinClaims& claims, const std::string& name, uint32_t use) {
  constexpr size_t kNonceDigits = 8;
  Identity worker{.fleet = claims.fleet,
                  .role = claims.role,
                  .name = absl::StrCat(name, "-", claims.nonce.substr(0, kNonceDigits))};
  if (claims.uses > 1) absl::StrAppend(&worker.name, "-", use);
  return worker;
}

}  // namespace

absl::StatusOr<std::unique_ptr<EnrollmentService>> EnrollmentService::Open(
    const EnrollmentOptions& options) {
  CertifiedKey own;
  ORBWEAVE_ASSIGN_OR_RETURN(own.certificate_pem, ReadTrustedFile(options.tls.AuthorityPath()));
  ORBWEAVE_ASSIGN_OR_RETURN(own.key_pem, ReadSecretFile(options.tls.AuthorityKeyPath()));
  ORBWEAVE_ASSIGN_OR_RETURN(std::string token_key, ReadSecretFile(options.tls.TokenKeyPath()));
  ORBWEAVE_ASSIGN_OR_RETURN(CertificateAuthority authority, CertificateAuthority::Load(own));
  ORBWEAVE_ASSIGN_OR_RETURN(std::shared_ptr<RevocationList> revocations,
                            OpenRevocations(options.tls, options.log));
  ORBWEAVE_ASSIGN_OR_RETURN(UsedTokens used,
                            UsedTokens::Open(options.used_folder, options.now_unix_s()));
  return std::unique_ptr<EnrollmentService>(new EnrollmentService(options,
                                                                  std::move(authority),
                                                                  std::move(token_key),
                                                                  std::move(revocations),
                                                                  std::move(used)));
}

absl::StatusOr<std::string> EnrollmentService::Enroll(const std::string& token,
                                                      const std::string& request_pem,
                                                      const std::string& name) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JoinClaims claims,
                            VerifyJoinToken(token_key_, token, options_.now_unix_s()));
  if (claims.fleet != authority_.fleet() || claims.role != Role::kWorker)
    return absl::PermissionDeniedError("the join token is not one of a worker of this fleet");
  ORBWEAVE_RETURN_IF_ERROR(revocations_->CheckToken(claims.nonce));
  // What can be wrong with a name or a request is found before the token is spent.
  ORBWEAVE_RETURN_IF_ERROR(Renew(BearerOf(claims, name, claims.uses), request_pem).status());
  ORBWEAVE_ASSIGN_OR_RETURN(const uint32_t use, used_.Use(claims));
  const Identity worker = BearerOf(claims, name, use);
  ORBWEAVE_ASSIGN_OR_RETURN(std::string certificate, Renew(worker, request_pem));
  if (options_.log) options_.log({.event = "certificate_given", .worker = worker.name});
  return certificate;
}

absl::StatusOr<std::string> EnrollmentService::Renew(const Identity& peer,
                                                     const std::string& request_pem) const {
  return authority_.Issue(
      request_pem,
      {.identity = peer, .now_unix_s = options_.now_unix_s(), .valid_s = options_.valid_s});
}

}  // namespace orbweave
