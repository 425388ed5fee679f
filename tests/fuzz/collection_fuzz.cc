// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/job_plan.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  orbweave::CheckRoundTrip(
      orbweave::BytesOf(data, size), orbweave::DecodeCollection, orbweave::EncodeCollection);
  return 0;
}
