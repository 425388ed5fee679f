// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace orbweave {

/// [v]x, the matrix with [v]x w = v x w.
Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v);

/// Rotation by |w| radians about w (Rodrigues); exact to rounding for |w| -> 0.
Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& w);

/// The rotation vector w, |w| in [0, pi], with RotationFromVector(w) = q.
Eigen::Vector3d VectorFromRotation(const Eigen::Quaterniond& q);

/// Angle of a rotation in radians, in [0, pi].
double RotationAngle(const Eigen::Quaterniond& q);

/// The shortest rotation that turns the non-zero vector `from` into the direction of `to`; of
/// opposite vectors half a turn about some axis orthogonal to them.
Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Two unit columns that span the plane orthogonal to the unit vector `bearing` (3x2). Chosen
/// without a singular direction jump at the poles or the seam: the axis least aligned with it.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& bearing);

/// Angle between two non-zero vectors in radians, accurate near 0 and pi.
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether AngleBetween(a, b) <= max_rad, at a fraction of its cost but for angles that are close
/// to it. Not of vectors that are not numbers.
bool IsWithinAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double max_rad);

}  // namespace orbweave
