// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rigid3.h"
#include "core/synthetic/camera_rays.h"
#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/street_hardships.h"
#include "core/synthetic/street_world.h"

namespace orbweave {

/// One shot of the camera on its carrier.
struct PanoramaView {
  EquirectangularCamera camera{};
  Rigid3 cam_from_street{};
  double exposure = 1.0;                  ///< gain of this panorama
  double noise_levels = 1.2;              ///< sensor noise, standard deviation of an 8-bit value
  bool mask_traffic = true;               ///< moving cars are ignored, too
  uint32_t seed = 0;                      ///< of the sensor noise
  Colour white_balance = Colour::Ones();  ///< gain of each channel
  double shade_noise_levels = 0.0;        ///< noise that grows from none at level 120 to this at 0
  double shade_blur_px = 0.0;             ///< soften_shade.h
  NadirKind nadir = NadirKind::kRoof;
  LensRig lenses{};
  RollingShutter shutter{};
};

/// Casts a ray through the middle (i + 0.5, j + 0.5) of every pixel; textures filter themselves to
/// the pixel's size, and pixels beside another surface or shadow are averaged over 3 x 3 rays.
/// The carrier's roof is fixed in the camera frame below the camera.
[[nodiscard]] RenderedPanorama RenderPanorama(const StreetWorld& world,
                                              const Traffic& traffic,
                                              const PanoramaView& view);

}  // namespace orbweave
