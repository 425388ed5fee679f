// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/cube_face.h"
#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

/// Somebody's equirectangular pixels: row-major, `channels` bytes each.
struct PanoramaPixels {
  EquirectangularCamera camera{};
  int channels = 3;
  std::span<const uint8_t> bytes{};
};

/// A face of the cube as a pinhole image of size_px x size_px pixels of `channels` bytes. Where it
/// has fewer pixels than the panorama each is the mean over its area, else bilinear; the seam and
/// the poles are no edges.
[[nodiscard]] std::vector<uint8_t> ResampleFace(const PanoramaPixels& panorama,
                                                int face,
                                                PinholeFace pinhole);

/// The six faces of an encoded panorama as JPEG files. InvalidArgument: it cannot be decoded, ends
/// early, or is not of the camera's size.
[[nodiscard]] absl::StatusOr<std::array<std::string, kCubeFaces>> EncodeCubeFaces(
    std::string_view encoded, const EquirectangularCamera& camera, PinholeFace pinhole);

/// The six faces of an encoded mask, of any size, as PNG files: 0 where pixels are to be ignored,
/// else 255. A pixel of the mask is white above mid-grey. InvalidArgument: it cannot be decoded.
[[nodiscard]] absl::StatusOr<std::array<std::string, kCubeFaces>> EncodeCubeMasks(
    std::string_view encoded, bool ignores_white, PinholeFace pinhole);

}  // namespace orbweave
