// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/status.h"
#include "objects/s3_address.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(orbweave::BytesOf(data, size));
  (void)orbweave::ParseS3Address(text);
  const absl::StatusOr<std::string> back =
      orbweave::UriDecode(orbweave::UriEncode(text, size % 2 == 0));
  ORBWEAVE_CHECK(back.ok() && *back == text);
  return 0;
}
