// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "core/synthetic/facade_look.h"

namespace orbweave {

enum class SolidKind : uint8_t {
  kBuilding,
  kFixture,
  kPole,
  kHedge,
  kCrown,
  kCarBody,
  kCarCabin,
  kBus,
  kPerson,
  kPlaster,    // of a room
  kFloor,      // of a room
  kFurniture,  // of a room
  kPicture     // on a room's wall
};

/// A box that stands upright, or the ellipsoid inscribed in it (kCrown, kPerson). Its own axes: x
/// along, y across, z up; turned by a yaw about z.
struct Solid {
  SolidKind kind = SolidKind::kBuilding;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the world
  Eigen::Vector3d half = Eigen::Vector3d::Ones();    ///< half extents along its own axes
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< its x axis in the world, unit
  uint32_t seed = 0;                                 ///< of its texture
  FacadeLook look{};                                 ///< of a building
  uint32_t leaves = 0;                               ///< of a crown: another number, other leaves

  [[nodiscard]] bool IsRound() const {
    return kind == SolidKind::kCrown || kind == SolidKind::kPerson;
  }

  [[nodiscard]] Eigen::Vector3d LocalDirection(const Eigen::Vector3d& d) const {
    return {along.x() * d.x() + along.y() * d.y(), along.x() * d.y() - along.y() * d.x(), d.z()};
  }
  [[nodiscard]] Eigen::Vector3d WorldDirection(const Eigen::Vector3d& d) const {
    return {along.x() * d.x() - along.y() * d.y(), along.y() * d.x() + along.x() * d.y(), d.z()};
  }
};

struct LightRay {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit
};

/// Faces of a box: 2 * axis, plus 1 on the positive side. An ellipsoid has face 0 only.
struct SolidHit {
  double distance_m = std::numeric_limits<double>::infinity();
  int face = -1;
};

/// First entry of the ray into the solid, at infinity when it misses or starts inside.
[[nodiscard]] SolidHit Intersect(const LightRay& ray, const Solid& solid);

/// Outward unit normal in the world at a point of the surface.
[[nodiscard]] Eigen::Vector3d SurfaceNormal(const Solid& solid,
                                            int face,
                                            const Eigen::Vector3d& point);

}  // namespace orbweave
