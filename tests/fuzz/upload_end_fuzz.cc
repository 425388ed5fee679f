// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/grants_codec.h"
#include "tests/fuzz/message_round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  orbweave::CheckMessageRoundTrip<orbweave::v1::FinishUploadRequest>(orbweave::BytesOf(data, size));
  return 0;
}
