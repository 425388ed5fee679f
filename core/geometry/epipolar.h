// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// Equation (7): angle in radians between the bearing p_b and the epipolar plane of p_a, whose
/// normal is E p_a / |E p_a|; in [0, pi/2]. pi/2 where p_a is the epipole and has no plane.
[[nodiscard]] double EpipolarAngle(const Eigen::Matrix3d& E,
                                   const Eigen::Vector3d& p_a,
                                   const Eigen::Vector3d& p_b);

/// The same in both images at once, the angle e with 1/sin^2 e = (1/sin^2 e_a + 1/sin^2 e_b) / 2:
/// equal to (7) where both images agree, and to sqrt(2) times the first-order (Sampson) distance on
/// the spheres. Near an epipole, where noise turns the plane, the better of the two images decides.
/// |T| = 1; p_a, p_b unit.
[[nodiscard]] double SymmetricEpipolarAngle(const Rigid3& b_from_a,
                                            const Eigen::Vector3d& p_a,
                                            const Eigen::Vector3d& p_b);

/// Cheirality on both spheres (paper 3.3): whether the point nearest to the two rays lies in front
/// of both, p . (R P + T) > 0. False for parallel rays.
[[nodiscard]] bool IsInFrontOfBoth(const Rigid3& b_from_a,
                                   const Eigen::Vector3d& p_a,
                                   const Eigen::Vector3d& p_b);

/// Two rays under a pose, for both of the above at once.
struct RayPair {
  double lift = 0.0;     ///< p_b^T E p_a
  double along_a = 0.0;  ///< T . R p_a
  double along_b = 0.0;  ///< T . p_b
  double cosine = 0.0;   ///< R p_a . p_b

  /// Of the normals E p_a and E^T p_b, the mean.
  [[nodiscard]] double SquaredNormal() const;
  [[nodiscard]] double SymmetricEpipolarAngle() const;
  /// SymmetricEpipolarAngle() <= max_rad, at a fraction of its cost but for angles that are close.
  [[nodiscard]] bool IsWithin(double max_rad) const;
  [[nodiscard]] bool IsInFrontOfBoth() const;
};

/// Many pairs of rays under one pose.
class PoseOfRays {
 public:
  explicit PoseOfRays(const Rigid3& b_from_a)
      : R_(b_from_a.rotation.toRotationMatrix()), T_(b_from_a.translation) {}

  /// p_a, p_b unit.
  [[nodiscard]] RayPair operator()(const Eigen::Vector3d& p_a, const Eigen::Vector3d& p_b) const {
    const Eigen::Vector3d q = R_ * p_a;
    return {p_b.dot(T_.cross(q)), T_.dot(q), T_.dot(p_b), q.dot(p_b)};
  }

 private:
  Eigen::Matrix3d R_;
  Eigen::Vector3d T_;
};

}  // namespace orbweave
