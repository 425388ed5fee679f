// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/two_view_codec.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(two_view_geometries) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::DecodeTwoViewGeometries,
                           orbweave::EncodeTwoViewGeometries);
}
