// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

/// Slabs: Kay and Kajiya, SIGGRAPH 1986.
SolidHit IntersectBox(const Eigen::Vector3d& o,
                      const Eigen::Vector3d& d,
                      const Eigen::Vector3d& half) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int face = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (std::abs(o[axis]) > half[axis]) return {};
      continue;
    }
    const double inverse = 1.0 / d[axis];
    const double near = (-std::copysign(half[axis], d[axis]) - o[axis]) * inverse;
    const double far = (std::copysign(half[axis], d[axis]) - o[axis]) * inverse;
    if (near > enter) {
      enter = near;
      face = 2 * axis + (d[axis] < 0.0 ? 1 : 0);
    }
    leave = std::min(leave, far);
  }
  return enter > 0.0 && enter < leave ? SolidHit{enter, face} : SolidHit{};
}

SolidHit IntersectEllipsoid(const Eigen::Vector3d& o,
                            const Eigen::Vector3d& d,
                            const Eigen::Vector3d& half) {
  const Eigen::Vector3d p = o.cwiseQuotient(half);
  const Eigen::Vector3d q = d.cwiseQuotient(half);
  const double a = q.squaredNorm();
  const double b = p.dot(q);
  const double discriminant = b * b - a * (p.squaredNorm() - 1.0);
  if (discriminant <= 0.0) return {};
  const double enter = (-b - std::sqrt(discriminant)) / a;
  return enter > 0.0 ? SolidHit{enter, 0} : SolidHit{};
}

}  // namespace

SolidHit Intersect(const LightRay& ray, const Solid& solid) {
  const Eigen::Vector3d o = solid.LocalDirection(ray.origin - solid.centre);
  const Eigen::Vector3d d = solid.LocalDirection(ray.direction);
  return solid.IsRound() ? IntersectEllipsoid(o, d, solid.half) : IntersectBox(o, d, solid.half);
}

Eigen::Vector3d SurfaceNormal(const Solid& solid, int face, const Eigen::Vector3d& point) {
  if (solid.IsRound()) {
    const Eigen::Vector3d p = solid.LocalDirection(point - solid.centre);
    return solid.WorldDirection(p.cwiseQuotient(solid.half.cwiseAbs2()).normalized());
  }
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[face / 2] = face % 2 == 1 ? 1.0 : -1.0;
  return solid.WorldDirection(normal);
}

}  // namespace orbweave
