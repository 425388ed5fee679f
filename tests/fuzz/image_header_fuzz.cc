// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pictures/image_header.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto header = orbweave::ReadImageHeader(orbweave::BytesOf(data, size));
  if (!header.ok()) return 0;
  constexpr int kMost = 1 << 30;
  ORBWEAVE_CHECK(header->width_px > 0 && header->width_px <= kMost);
  ORBWEAVE_CHECK(header->height_px > 0 && header->height_px <= kMost);
  return 0;
}
