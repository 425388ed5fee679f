// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/carrier_codec.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size), orbweave::DecodeCarriers, orbweave::EncodeCarriers);
  return 0;
}
