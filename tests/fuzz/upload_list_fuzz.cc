// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_answers.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  (void)orbweave::ParseUploads(orbweave::BytesOf(data, size));
  (void)orbweave::ParseUpload(orbweave::BytesOf(data, size));
  return 0;
}
