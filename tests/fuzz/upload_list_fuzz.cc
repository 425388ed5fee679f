// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_answers.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(upload_list) {
  (void)orbweave::ParseUploads(orbweave::BytesOf(data, size));
  (void)orbweave::ParseUpload(orbweave::BytesOf(data, size));
}
