// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/geodetic_from_enu.h"

#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr double kEquatorRadius_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);
constexpr double kDegree = std::numbers::pi / 180.0;

/// Radius of curvature in the prime vertical.
double PrimeVerticalRadius(double latitude_rad) {
  const double s = std::sin(latitude_rad);
  return kEquatorRadius_m / std::sqrt(1.0 - kEccentricitySquared * s * s);
}

Eigen::Vector3d EcefFromGeodetic(const GeodeticPosition& position) {
  const double phi = position.latitude_deg * kDegree;
  const double lambda = position.longitude_deg * kDegree;
  const double N = PrimeVerticalRadius(phi);
  const double h = position.altitude_m;
  return {(N + h) * std::cos(phi) * std::cos(lambda),
          (N + h) * std::cos(phi) * std::sin(lambda),
          (N * (1.0 - kEccentricitySquared) + h) * std::sin(phi)};
}

GeodeticPosition GeodeticFromEcef(const Eigen::Vector3d& point) {
  const double p = std::hypot(point.x(), point.y());
  double phi = std::atan2(point.z(), p * (1.0 - kEccentricitySquared));
  double h = 0.0;
  for (int i = 0; i < 6; ++i) {  // gains about 2.5 digits a round
    const double N = PrimeVerticalRadius(phi);
    h = p / std::cos(phi) - N;
    phi = std::atan2(point.z(), p * (1.0 - kEccentricitySquared * N / (N + h)));
  }
  return {phi / kDegree, std::atan2(point.y(), point.x()) / kDegree, h};
}

/// Columns: east, north and up at `origin`, in the earth-centred frame.
Eigen::Matrix3d EcefFromEnuRotation(const GeodeticPosition& origin) {
  const double sin_phi = std::sin(origin.latitude_deg * kDegree);
  const double cos_phi = std::cos(origin.latitude_deg * kDegree);
  const double sin_lambda = std::sin(origin.longitude_deg * kDegree);
  const double cos_lambda = std::cos(origin.longitude_deg * kDegree);
  Eigen::Matrix3d R;
  R.col(0) << -sin_lambda, cos_lambda, 0.0;
  R.col(1) << -sin_phi * cos_lambda, -sin_phi * sin_lambda, cos_phi;
  R.col(2) << cos_phi * cos_lambda, cos_phi * sin_lambda, sin_phi;
  return R;
}

}  // namespace

GeodeticPosition GeodeticFromEnu(const GeodeticPosition& origin,
                                 const Eigen::Vector3d& position_in_enu) {
  return GeodeticFromEcef(EcefFromGeodetic(origin) + EcefFromEnuRotation(origin) * position_in_enu);
}

}  // namespace orbweave
