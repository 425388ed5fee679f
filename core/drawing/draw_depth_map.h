// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"
#include "core/dense/depth_map.h"
#include "core/drawing/picture_image.h"

namespace orbweave {

/// The bytes of a JPEG file, kPictureWidth_px / 2 wide: the panorama, and below it the distance of
/// what it sees, coloured by ColorOnScale over the logarithm from the distance that 2 % are nearer
/// than to the one that 2 % are farther than; both, and the middle, are written there with `unit`.
/// Dark: no distance is known.
[[nodiscard]] absl::StatusOr<std::string> DrawDepthMap(const PictureImage& image,
                                                       const DepthMap& map,
                                                       const std::string& unit);

}  // namespace orbweave
