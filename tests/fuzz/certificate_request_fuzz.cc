// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate.h"
#include "security/certificate_authority.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

namespace {

orbweave::CertificateAuthority MakeAuthority() {
  const auto own = orbweave::CertificateAuthority::Make("city", 1'000'000, 3600);
  ORBWEAVE_CHECK(own.ok());
  auto authority = orbweave::CertificateAuthority::Load(*own);
  ORBWEAVE_CHECK(authority.ok());
  return *std::move(authority);
}

}  // namespace

FUZZ_TARGET(certificate_request) {
  static const orbweave::CertificateAuthority authority = MakeAuthority();
  const auto issued = authority.Issue(orbweave::BytesOf(data, size),
                                      {.identity = {"city", orbweave::Role::kWorker, "node"},
                                       .now_unix_s = 1'000'000,
                                       .valid_s = 60});
  // Whatever it was asked for, a certificate says what the authority meant.
  if (issued.ok()) ORBWEAVE_CHECK(orbweave::ReadCertificate(*issued)->identity.name == "node");
}
