// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/erp_residual.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr double kMinCosine = 1e-3;  // of the latitude, in the derivative of the longitude

struct LongitudeLatitude {
  double longitude = 0.0;
  double latitude = 0.0;
};

LongitudeLatitude Angles(const Eigen::Vector3d& ray) {
  return {std::atan2(ray.x(), ray.z()), std::atan2(ray.y(), std::hypot(ray.x(), ray.z()))};
}

}  // namespace

BearingResidual EvaluateErpResidual(const Eigen::Matrix3d& R,
                                    const Eigen::Vector3d& centre_in_world,
                                    const Eigen::Vector3d& point_in_world,
                                    const Eigen::Vector3d& bearing) {
  BearingResidual result;
  const Eigen::Vector3d d = point_in_world - centre_in_world;
  const double range = d.norm();
  if (!(range > 0.0)) return result;
  const Eigen::Vector3d u = R * (d / range);
  const LongitudeLatitude predicted = Angles(u);
  const LongitudeLatitude observed = Angles(bearing);
  result.r = {std::remainder(predicted.longitude - observed.longitude, 2.0 * std::numbers::pi),
              predicted.latitude - observed.latitude};

  // East and south: unit tangents of the sphere at u. d longitude = east . du / cos(latitude).
  const double sine = std::sin(predicted.longitude);
  const double cosine = std::cos(predicted.longitude);
  const double radius = std::hypot(u.x(), u.z());
  Eigen::Matrix<double, 2, 3> d_unit;
  d_unit.row(0) = Eigen::RowVector3d(cosine, 0.0, -sine) / std::max(radius, kMinCosine);
  d_unit.row(1) = Eigen::RowVector3d(-sine * u.y(), radius, -cosine * u.y());
  result.d_point = d_unit * R / range;
  result.d_pose.leftCols<3>() = -result.d_point * SkewSymmetric(d);
  result.d_pose.rightCols<3>() = -result.d_point;
  return result;
}

}  // namespace orbweave
