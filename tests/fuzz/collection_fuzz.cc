// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(collection) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size), orbweave::DecodeCollection, orbweave::EncodeCollection);
}
