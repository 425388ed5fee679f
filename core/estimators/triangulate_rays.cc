// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/triangulate_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/container/inlined_vector.h"
#include "core/base/status.h"
#include "core/estimators/intersect_rays.h"

namespace orbweave {

using Eigen::Vector3d;

std::optional<Vector3d> TriangulateRays(std::span<const Rigid3> cams_from_world,
                                        std::span<const Vector3d> bearings) {
  ORBWEAVE_CHECK(cams_from_world.size() == bearings.size());
  if (bearings.size() < 2) return std::nullopt;
  const std::optional<Vector3d> X = IntersectRays(RaysFromFirstCamera(cams_from_world, bearings));
  if (!X) return std::nullopt;
  return cams_from_world[0].Centre() + *X;
}

double MaxTriangulationAngle(const Vector3d& point_in_world, std::span<const Vector3d> centres) {
  absl::InlinedVector<Vector3d, 16> to_centres(centres.size());
  for (size_t i = 0; i < centres.size(); ++i)
    to_centres[i] = (centres[i] - point_in_world).normalized();
  double max_squared_chord = 0.0;
  for (size_t i = 0; i < centres.size(); ++i) {
    for (size_t j = i + 1; j < centres.size(); ++j) {
      max_squared_chord =
          std::max(max_squared_chord, (to_centres[i] - to_centres[j]).squaredNorm());
    }
  }
  return 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(max_squared_chord)));
}

double RangeGap(const Vector3d& point_in_world, std::span<const Vector3d> centres) {
  if (centres.size() < 2) return 1.0;
  double nearest = std::numeric_limits<double>::infinity();
  double second = nearest;
  for (const Vector3d& centre : centres) {
    const double range = (centre - point_in_world).norm();
    second = std::min(second, std::max(range, nearest));
    nearest = std::min(nearest, range);
  }
  return second / nearest;
}

}  // namespace orbweave
