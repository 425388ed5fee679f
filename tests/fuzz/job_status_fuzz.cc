// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/message_round_trip.h"

FUZZ_TARGET(job_status) {
  orbweave::CheckMessageRoundTrip<orbweave::v1::JobStatus>(orbweave::BytesOf(data, size));
}
