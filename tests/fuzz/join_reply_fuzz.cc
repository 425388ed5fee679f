// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/message_round_trip.h"

FUZZ_TARGET(join_reply) {
  orbweave::CheckMessageRoundTrip<orbweave::v1::JoinReply>(orbweave::BytesOf(data, size));
}
