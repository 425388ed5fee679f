// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

/// The pixels of a panorama, row by row.
struct DecodedRaster {
  EquirectangularCamera camera{};
  std::vector<uint8_t> rgb{};      ///< three a pixel
  std::vector<uint8_t> ignored{};  ///< one a pixel, not 0: under the mask; empty without one
};

/// DecodePanorama and DecodeMask (`encoded_mask` may be empty) as bytes, brought to a width of
/// `width_px` (even) by area where that is less. InvalidArgument, a sentence for people: one of the
/// two cannot be used, or the panorama is not as large as `camera`.
[[nodiscard]] absl::StatusOr<DecodedRaster> DecodeRaster(std::string_view encoded,
                                                         std::string_view encoded_mask,
                                                         bool mask_ignores_white,
                                                         const EquirectangularCamera& camera,
                                                         int width_px);

}  // namespace orbweave
