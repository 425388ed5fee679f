// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_panorama.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(panorama) {
  constexpr int kMaxWidth_px = 128;
  const auto image = orbweave::DecodePanorama(orbweave::BytesOf(data, size), kMaxWidth_px);
  if (!image.ok()) return;
  ORBWEAVE_CHECK(image->cols > 0 && image->cols <= kMaxWidth_px && image->type() == CV_8UC3);
}
