// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "core/io/images/image_metadata.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(image_metadata) {
  const auto metadata = orbweave::ReadImageMetadata(orbweave::BytesOf(data, size));
  if (!metadata.ok()) return;
  ORBWEAVE_CHECK(metadata->width_px > 0 && metadata->height_px > 0);
  if (metadata->heading_deg) ORBWEAVE_CHECK(std::isfinite(*metadata->heading_deg));
  if (!metadata->position) return;
  ORBWEAVE_CHECK(std::abs(metadata->position->latitude_deg) <= 90.0);
  ORBWEAVE_CHECK(std::abs(metadata->position->longitude_deg) <= 180.0);
  ORBWEAVE_CHECK(std::isfinite(metadata->position->altitude_m));
}
