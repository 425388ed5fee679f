// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/identity.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(identity) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::Identity::FromUri,
                           [](const auto& identity) { return identity.ToUri(); });
}
