// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/identity.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::Identity::FromUri,
                           [](const auto& identity) { return identity.ToUri(); });
  return 0;
}
