// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/revocations.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(revocations) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size), orbweave::RevocationsFromText, orbweave::RevocationsToText);
}
