// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/synthetic/solid.h"
#include "core/synthetic/solid_grid.h"
#include "core/synthetic/street_hardships.h"
#include "core/synthetic/street_layout.h"
#include "core/synthetic/texture.h"

namespace orbweave {

/// Sun and sky of one day.
struct Daylight {
  Eigen::Vector3d to_sun = Eigen::Vector3d(0.45, -0.55, 0.80).normalized();
  double sun = 0.62;    ///< brightness of a white surface that faces it
  double sky = 0.62;    ///< brightness of a white upright surface in the shade
  double above = 1.0;   ///< brightness of sky and clouds themselves; beyond 1 they are overexposed
  uint32_t clouds = 0;  ///< another number, other clouds
  Eigen::Vector2d cloud_drift = Eigen::Vector2d::Zero();  ///< way gone, in heights of the clouds
};

/// A street that stands still, in its own frame (street_layout.h).
struct StreetWorld {
  StreetLayout layout;
  std::vector<Solid> solids{};
  SolidGrid grid{};  ///< of `solids`
  uint32_t seed = 0;
  Daylight light{};
  double ground_contrast = 1.0;
  double reflection = 0.0;  ///< share of what glass mirrors that is to be seen
};

/// The street that a drive of `length_m` goes round; long enough drives meet their start.
[[nodiscard]] StreetWorld MakeStreetWorld(double length_m,
                                          uint64_t seed,
                                          const StreetHardships& hardships = {});

/// What moves while one panorama is taken.
struct Traffic {
  explicit Traffic(const std::vector<Solid>& moving) : cars(moving), grid(moving) {}

  std::vector<Solid> cars;
  SolidGrid grid;
};

/// What a ray meets first.
struct SurfaceHit {
  static constexpr uint32_t kSky = 0;
  static constexpr uint32_t kGround = 1;

  uint32_t surface = kSky;  ///< one number per face of every solid
  uint32_t solid = 0;       ///< index into the world's solids, or the traffic's cars
  int face = 0;
  bool moving = false;
  bool in_sun = false;
  double distance_m = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();

  /// Whether a pixel between two such hits needs more than one ray.
  [[nodiscard]] bool LooksLike(const SurfaceHit& other) const {
    return surface == other.surface && in_sun == other.in_sun;
  }
};

[[nodiscard]] SurfaceHit Trace(const StreetWorld& world,
                               const Traffic& traffic,
                               const LightRay& ray);

/// Colour of a hit for a pixel of `pixel_rad`: texture times sunlight and shadow, and what its
/// glass mirrors (once; Schlick's approximation of Fresnel's equations).
[[nodiscard]] Colour Shade(const StreetWorld& world,
                           const Traffic& traffic,
                           const LightRay& ray,
                           const SurfaceHit& hit,
                           double pixel_rad);

}  // namespace orbweave
