// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/features_codec.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(features) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size), orbweave::DecodeFeatures, orbweave::EncodeFeatures);
}
