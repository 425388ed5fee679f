// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/sky_drift.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "core/estimators/refine_two_view.h"
#include "core/geometry/rotation.h"
#include "core/robust/levenberg_marquardt.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kClearSquares = 16.27;  // chi-squared of three freedoms, one in a thousand
constexpr size_t kPoseFreedoms = 5;
constexpr size_t kTurnFreedoms = 3;

/// Of the rotation that takes far bearings of one panorama to those of the other.
Linearisation<3> LineariseTurn(const Quaterniond& rotation,
                               const BearingPairs& far,
                               double loss_scale_rad) {
  const double squared_scale = loss_scale_rad * loss_scale_rad;
  Linearisation<3> sum;
  for (size_t i = 0; i < far.Size(); ++i) {
    const Vector3d turned = rotation * far.A(i);
    const Vector3d error = far.B(i) - turned;
    const double weight = squared_scale / (squared_scale + error.squaredNorm());
    const Eigen::Matrix<double, 3, 2> tangents = TangentBasis(turned);
    for (int k = 0; k < 2; ++k) {
      const Vector3d tangent = tangents.col(k);
      sum.Add(tangent.dot(error), -turned.cross(tangent), weight);
    }
    sum.cost += squared_scale * std::log1p(error.squaredNorm() / squared_scale);
  }
  return sum;
}

/// Of the rotation among the unknowns of a fit; nothing is known where it is not determined or
/// nothing is left over.
template <int N>
Matrix3d RotationCovariance(const Linearisation<N>& fit, size_t equations, size_t freedoms) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix3d unknown = Matrix3d::Constant(std::numeric_limits<double>::infinity());
  if (equations <= freedoms) return unknown;
  const Eigen::LDLT<Matrix, Eigen::Lower> ldlt(fit.H);
  if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return unknown;
  const Matrix inverse = ldlt.solve(Matrix::Identity());
  if (!inverse.allFinite()) return unknown;
  const Matrix3d of_rotation = inverse.template topLeftCorner<3, 3>();
  return of_rotation * (fit.cost / static_cast<double>(equations - freedoms));
}

}  // namespace

bool SkyDrift::IsClear() const {
  if (!covariance.allFinite()) return false;
  const Eigen::LDLT<Matrix3d> ldlt(covariance);
  return ldlt.info() == Eigen::Success && ldlt.isPositive() &&
         turn_rad.dot(ldlt.solve(turn_rad)) > kClearSquares;
}

SkyDrift MeasureSkyDrift(const BearingPairs& far,
                         const BearingPairs& scene,
                         const Rigid3& b_from_a,
                         double max_error_rad) {
  const double loss_scale_rad = 0.5 * max_error_rad;
  const auto linearise = [&](const Quaterniond& rotation) {
    return LineariseTurn(rotation, far, loss_scale_rad);
  };
  const auto turn = [](const Quaterniond& rotation, const Vector3d& theta) {
    return (RotationFromVector(theta) * rotation).normalized();
  };
  const Quaterniond of_far = MinimiseLevenbergMarquardt<3>(b_from_a.rotation, linearise, turn);
  const SelectedBearings selected = SelectPairs(scene, AllOf(scene));
  const Linearisation<5> of_scene =
      LineariseEpipolarResiduals(b_from_a, selected.a, selected.b, loss_scale_rad);
  return {.turn_rad = VectorFromRotation(of_far * b_from_a.rotation.conjugate()),
          .covariance = RotationCovariance(linearise(of_far), 2 * far.Size(), kTurnFreedoms) +
                        RotationCovariance(of_scene, scene.Size(), kPoseFreedoms)};
}

}  // namespace orbweave
