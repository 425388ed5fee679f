// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/certificate_request.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(private_key) {
  const auto request = orbweave::MakeCertificateRequest(orbweave::BytesOf(data, size));
  if (request.ok()) ORBWEAVE_CHECK(request->starts_with("-----BEGIN CERTIFICATE REQUEST-----"));
}
