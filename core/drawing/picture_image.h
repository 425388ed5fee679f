// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

/// A panorama as a picture shows it.
struct PictureImage {
  std::string name{};
  std::string encoded{};  ///< the file's bytes; empty: no pixels are known, the ground is dark
  EquirectangularCamera camera{};
};

}  // namespace orbweave
