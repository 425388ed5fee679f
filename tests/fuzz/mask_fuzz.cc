// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_panorama.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(mask) {
  const cv::Size panorama(32, 16);
  const auto mask = orbweave::DecodeMask(orbweave::BytesOf(data, size), panorama, 128, true);
  if (mask.ok()) ORBWEAVE_CHECK(mask->size() == panorama && mask->type() == CV_8UC1);
}
