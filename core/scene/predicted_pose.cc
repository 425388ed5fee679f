// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/predicted_pose.h"

#include "core/geometry/angle_to_arc.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

/// Verified pairs know rotations to some tenths of a degree, and directions to some degrees where
/// panoramas are far apart.
constexpr double kTurned_rad = 0.05;
constexpr double kPast_rad = 0.17;

}  // namespace

double PredictedPose::TurnedFrom(const Rigid3& b_from_a) const {
  return RotationAngle(rotation.conjugate() * b_from_a.rotation);
}

double PredictedPose::LeadsPast(const Rigid3& b_from_a) const {
  return AngleToArc(b_from_a.Centre().normalized(), first, last);
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
