// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/grants_codec.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/message_round_trip.h"

FUZZ_TARGET(upload_end) {
  orbweave::CheckMessageRoundTrip<orbweave::v1::FinishUploadRequest>(orbweave::BytesOf(data, size));
}
