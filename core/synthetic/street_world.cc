// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_world.h"

#include <cmath>

#include "core/base/random.h"
#include "core/synthetic/ground_texture.h"
#include "core/synthetic/sky_texture.h"
#include "core/synthetic/solid_texture.h"
#include "core/synthetic/street_solids.h"

namespace orbweave {
namespace {

constexpr uint32_t kSurfacesPerSolid = 8;
constexpr double kFarthest_m = 400.0;
constexpr double kPaneReflection = 0.15;  // of double glazing: four surfaces of 4 %

/// Whether sunlight reaches a point of a surface.
bool IsInSun(const StreetWorld& world,
             const Traffic& traffic,
             const Eigen::Vector3d& point,
             const Eigen::Vector3d& normal) {
  constexpr double kOffSurface_m = 1e-4;
  const Eigen::Vector3d& to_sun = world.light.to_sun;
  if (normal.dot(to_sun) <= 0.0) return false;
  const LightRay ray{point + kOffSurface_m * normal, to_sun};
  return !world.grid.IsHit(ray) && !traffic.grid.IsHit(ray);
}

SurfaceHit SolidSurface(const std::vector<Solid>& solids,
                        const GridHit& found,
                        const LightRay& ray,
                        bool moving) {
  SurfaceHit hit{.solid = found.solid, .face = found.hit.face, .moving = moving};
  hit.surface = 2 + kSurfacesPerSolid * found.solid + static_cast<uint32_t>(found.hit.face) +
                (moving ? 1U << 31 : 0U);
  hit.distance_m = found.hit.distance_m;
  hit.point = ray.origin + hit.distance_m * ray.direction;
  hit.normal = SurfaceNormal(solids[found.solid], found.hit.face, hit.point);
  return hit;
}

/// Colour under sun and sky, without what it mirrors.
SurfaceColour Lit(const StreetWorld& world,
                  const Traffic& traffic,
                  const LightRay& ray,
                  const SurfaceHit& hit,
                  double pixel_rad) {
  if (hit.surface == SurfaceHit::kSky) {
    const Colour sky = SkyColour(
        ray.direction, pixel_rad, world.seed + 5, world.light.clouds, world.light.cloud_drift);
    return {world.light.above * sky};
  }
  const double pixel_m = pixel_rad * hit.distance_m;
  SurfaceColour seen;
  if (hit.surface == SurfaceHit::kGround) {
    const double footprint_m = pixel_m / std::abs(ray.direction.z());
    seen.colour = GroundColour(
        world.layout, hit.point.head<2>(), footprint_m, world.seed, world.ground_contrast);
  } else {
    const Solid& solid = hit.moving ? traffic.cars[hit.solid] : world.solids[hit.solid];
    seen = LookOfSolid(solid, hit.face, hit.point, ray.direction, pixel_m);
  }
  const double sky_light = world.light.sky + 0.08 * hit.normal.z();
  const double sun_light = hit.in_sun ? world.light.sun * hit.normal.dot(world.light.to_sun) : 0.0;
  seen.colour *= sky_light + sun_light;
  return seen;
}

/// Panes hang up to a degree askew, so that a mirrored edge breaks from window to window.
Eigen::Vector3d NormalOfPane(const Eigen::Vector3d& normal, uint32_t pane) {
  constexpr double kAskew = 0.035;
  const Eigen::Vector3d shift(UniformOf(1, 2, pane), UniformOf(2, 2, pane), UniformOf(3, 2, pane));
  return (normal + kAskew * (shift - Eigen::Vector3d::Constant(0.5))).normalized();
}

}  // namespace

StreetWorld MakeStreetWorld(double length_m, uint64_t seed, const StreetHardships& hardships) {
  StreetWorld world{.layout = MakeStreetLayout(length_m)};
  world.seed = static_cast<uint32_t>(Random(seed).Next() >> 32);
  world.solids = MakeStreetSolids(world.layout, seed, hardships);
  world.ground_contrast = 1.0 - hardships.plain_share;
  world.reflection = hardships.reflection;
  world.light.sky *= 1.0 - hardships.harsh_light;
  world.light.sun *= 1.0 + hardships.harsh_light;
  world.light.above *= 1.0 + 2.0 * hardships.harsh_light;
  world.grid = SolidGrid(world.solids);
  return world;
}

SurfaceHit Trace(const StreetWorld& world, const Traffic& traffic, const LightRay& ray) {
  double limit_m = kFarthest_m;
  SurfaceHit hit;
  if (ray.direction.z() < 0.0) {
    const double ground_m = (kStreetGround_m - ray.origin.z()) / ray.direction.z();
    if (ground_m < limit_m) {
      limit_m = ground_m;
      hit.surface = SurfaceHit::kGround;
      hit.distance_m = ground_m;
      hit.point = ray.origin + ground_m * ray.direction;
    }
  }
  const GridHit standing = world.grid.Nearest(ray, limit_m);
  const GridHit moving = traffic.grid.Nearest(ray, limit_m);
  if (moving.hit.distance_m < standing.hit.distance_m) {
    hit = SolidSurface(traffic.cars, moving, ray, true);
  } else if (standing.hit.face >= 0) {
    hit = SolidSurface(world.solids, standing, ray, false);
  }
  if (hit.surface != SurfaceHit::kSky) hit.in_sun = IsInSun(world, traffic, hit.point, hit.normal);
  return hit;
}

Colour Shade(const StreetWorld& world,
             const Traffic& traffic,
             const LightRay& ray,
             const SurfaceHit& hit,
             double pixel_rad) {
  const SurfaceColour seen = Lit(world, traffic, ray, hit, pixel_rad);
  if (world.reflection * seen.glass < 0.01) return seen.colour;
  const double toward = std::clamp(-ray.direction.dot(hit.normal), 0.0, 1.0);
  const double mirrored = kPaneReflection + (1.0 - kPaneReflection) * std::pow(1.0 - toward, 5);
  const Eigen::Vector3d normal = NormalOfPane(hit.normal, seen.pane);
  const LightRay onwards{hit.point + 1e-4 * hit.normal,
                         ray.direction - 2.0 * ray.direction.dot(normal) * normal};
  if (onwards.direction.dot(hit.normal) <= 0.0) return seen.colour;
  SurfaceHit beyond = Trace(world, traffic, onwards);
  beyond.distance_m += hit.distance_m;  // of the whole way, to which the pixel's size belongs
  const Colour mirror = Lit(world, traffic, onwards, beyond, pixel_rad).colour;
  return Mix(seen.colour, mirror, world.reflection * seen.glass * mirrored);
}

}  // namespace orbweave
