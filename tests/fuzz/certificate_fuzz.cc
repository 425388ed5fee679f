// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto facts = orbweave::ReadCertificate(orbweave::BytesOf(data, size));
  if (facts.ok()) ORBWEAVE_CHECK(orbweave::Identity::FromUri(facts->identity.ToUri()).ok());
  return 0;
}
