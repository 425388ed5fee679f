// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/digest.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(digest) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::Digest::FromHex,
                           [](const auto& digest) { return digest.ToHex(); });
}
