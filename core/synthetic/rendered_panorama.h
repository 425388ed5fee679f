// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/features.h"

namespace orbweave {

/// Row-major pixels, and 255 where they are to be ignored: the carrier's roof or what covers the
/// nadir, moving cars.
struct RenderedPanorama {
  EquirectangularCamera camera{};
  std::vector<Rgb> pixels{};
  std::vector<uint8_t> ignored{};
};

}  // namespace orbweave
