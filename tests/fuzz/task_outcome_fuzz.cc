// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/message_round_trip.h"

FUZZ_TARGET(task_outcome) {
  orbweave::CheckMessageRoundTrip<orbweave::v1::TaskOutcome>(orbweave::BytesOf(data, size));
}
