// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/predicted_pose.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Verified pairs know rotations to some tenths of a degree, and directions to some degrees where
/// panoramas are far apart.
constexpr double kTurned_rad = 0.05;
constexpr double kPast_rad = 0.17;

}  // namespace

double PredictedPose::TurnedFrom(const Rigid3& b_from_a) const {
  return RotationAngle(rotation.conjugate() * b_from_a.rotation);
}

double PredictedPose::LeadsPast(const Rigid3& b_from_a) const {
  const Vector3d direction = b_from_a.Centre().normalized();
  const Vector3d normal = first.cross(last);
  const bool is_within = normal.cross(first).dot(direction) >= 0.0 &&
                         last.cross(normal).dot(direction) >= 0.0 && normal.norm() > 0.0;
  if (is_within)
    return std::abs(std::asin(std::clamp(normal.normalized().dot(direction), -1.0, 1.0)));
  return std::min(AngleBetween(first, direction), AngleBetween(last, direction));
}

bool PredictedPose::TurnsLike(const Eigen::Quaterniond& other) const {
  return RotationAngle(rotation.conjugate() * other) <= kTurned_rad;
}

bool PredictedPose::AgreesWith(const Rigid3& b_from_a) const {
  return TurnsLike(b_from_a.rotation) && LeadsPast(b_from_a) <= kPast_rad;
}

PredictedPose PredictPose(const Rigid3& m_from_a, const Rigid3& b_from_m) {
  return {.rotation = (b_from_m.rotation * m_from_a.rotation).normalized(),
          .first = m_from_a.Centre().normalized(),
          .last = (m_from_a.rotation.conjugate() * b_from_m.Centre()).normalized()};
}

}  // namespace orbweave
