// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(certificate) {
  const auto facts = orbweave::ReadCertificate(orbweave::BytesOf(data, size));
  if (facts.ok()) ORBWEAVE_CHECK(orbweave::Identity::FromUri(facts->identity.ToUri()).ok());
}
