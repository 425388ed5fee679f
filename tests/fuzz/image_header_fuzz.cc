// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pictures/image_header.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(image_header) {
  const auto header = orbweave::ReadImageHeader(orbweave::BytesOf(data, size));
  if (!header.ok()) return;
  constexpr int kMost = 1 << 30;
  ORBWEAVE_CHECK(header->width_px > 0 && header->width_px <= kMost);
  ORBWEAVE_CHECK(header->height_px > 0 && header->height_px <= kMost);
}
