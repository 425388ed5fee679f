// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/status.h"
#include "objects/s3_address.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(s3_address) {
  const std::string text(orbweave::BytesOf(data, size));
  (void)orbweave::ParseS3Address(text);
  const absl::StatusOr<std::string> back =
      orbweave::UriDecode(orbweave::UriEncode(text, size % 2 == 0));
  ORBWEAVE_CHECK(back.ok() && *back == text);
}
