// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate_authority.h"
#include "security/certificate_request.h"
#include "security/join_token.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {

void AddSecuritySeeds(Seeds& seeds) {
  constexpr int64_t kNow = 1'700'000'000;
  const CertifiedKey own = *CertificateAuthority::Make("city", kNow, 3600);
  const CertificateAuthority authority = *CertificateAuthority::Load(own);
  const std::string request = *MakeCertificateRequest(own.key_pem);
  seeds["certificate"] = {*authority.Issue(request,
                                           {.identity = {"city", Role::kCoordinator, "node"},
                                            .hosts = {"localhost", "127.0.0.1"},
                                            .now_unix_s = kNow,
                                            .valid_s = 60}),
                          own.certificate_pem};
  seeds["certificate_request"] = {request};
  // Of nobody: these keys certify nothing.
  seeds["private_key"] = {own.key_pem};
  seeds["join_token"] = {MakeJoinToken(
      MakeTokenKey(),
      {.fleet = "city", .expires_unix_s = kNow, .authority_pem = own.certificate_pem})};
}

}  // namespace orbweave
