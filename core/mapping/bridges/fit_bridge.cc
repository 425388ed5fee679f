// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/fit_bridge.h"

#include <Eigen/LU>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/robust/levenberg_marquardt.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Normal7 = Linearisation<7>;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 7>;

constexpr int kMaxSteps = 50;
/// What holds the scale of a single camera, which nothing else does.
constexpr double kHeldScaleSigma = 1e-3;

/// Steps are (turn about the axes of a, logarithm of the scale, translation).
Sim3 Move(const Sim3& a_from_b, const Eigen::Matrix<double, 7, 1>& step) {
  return {a_from_b.scale * std::exp(step[3]),
          (RotationFromVector(step.head<3>()) * a_from_b.rotation).normalized(),
          a_from_b.translation + step.tail<3>()};
}

/// Adds whitened residuals that are one observation under a Cauchy loss of one sigma.
void Add(const Eigen::VectorXd& r, const Jacobian& J, Normal7& sum) {
  const CauchyLoss loss(1.0);
  const double weight = loss.Weight(r.squaredNorm());
  for (Eigen::Index i = 0; i < r.size(); ++i) sum.Add(r[i], J.row(i).transpose(), weight);
  sum.cost += loss.Cost(r.squaredNorm());
}

/// y = a_from_b x as a function of the step.
Eigen::Matrix<double, 3, 7> JacobianOfPoint(const Sim3& a_from_b, const Vector3d& x) {
  const Vector3d turned = a_from_b.scale * (a_from_b.rotation * x);
  Eigen::Matrix<double, 3, 7> J;
  J << -SkewSymmetric(turned), turned, Matrix3d::Identity();
  return J;
}

void AddTurn(const PairTurn& turn, const Sim3& a_from_b, Normal7& sum) {
  Jacobian J = Jacobian::Zero(3, 7);
  J.leftCols<3>() = Matrix3d::Identity() / turn.sigma_rad;
  Add(VectorFromRotation(a_from_b.rotation * turn.a_from_b.conjugate()) / turn.sigma_rad, J, sum);
}

/// A ray `v` in the frame of its camera, and how it moves with the step.
void AddRay(const Vector3d& v,
            const Eigen::Matrix<double, 3, 7>& dv,
            const BridgeSight& sight,
            Normal7& sum) {
  const double distance = v.norm();
  if (!(distance > 0.0)) return;
  const Vector3d u = v / distance;
  const Eigen::Matrix<double, 3, 2> basis = TangentBasis(sight.bearing);
  // The length of the residual is the angle, however large: the sine alone would take a point
  // behind the camera for one in front.
  const Eigen::Vector2d tangent = basis.transpose() * u;
  const double sine = tangent.norm();
  const double angle = std::atan2(sine, u.dot(sight.bearing));
  const double stretch = sine > 1e-9 ? angle / sine : 1.0;
  const Matrix3d across = (Matrix3d::Identity() - u * u.transpose()) / distance;
  Add(stretch / sight.sigma_rad * tangent,
      stretch / sight.sigma_rad * (basis.transpose() * across * dv),
      sum);
}

void AddSightFromA(const BridgeSight& sight, const Sim3& a_from_b, Normal7& sum) {
  const Matrix3d R = sight.cam_from_own.rotation.toRotationMatrix();
  AddRay(sight.cam_from_own * (a_from_b * sight.point_in_other),
         R * JacobianOfPoint(a_from_b, sight.point_in_other),
         sight,
         sum);
}

void AddSightFromB(const BridgeSight& sight, const Sim3& a_from_b, Normal7& sum) {
  const Matrix3d cam_from_a =
      (sight.cam_from_own.rotation * a_from_b.rotation.conjugate()).toRotationMatrix();
  const Vector3d centre_in_b = sight.cam_from_own.Centre();
  const Vector3d from_origin = sight.point_in_other - a_from_b.translation;
  const Vector3d scaled_centre = a_from_b.scale * (a_from_b.rotation * centre_in_b);
  Eigen::Matrix<double, 3, 7> J;
  J << cam_from_a * SkewSymmetric(from_origin), -cam_from_a * scaled_centre, -cam_from_a;
  AddRay(cam_from_a * (from_origin - scaled_centre), J, sight, sum);
}

void AddFix(const BridgeFix& fix, const Sim3& enu_from_a, const Sim3& a_from_b, Normal7& sum) {
  const Vector3d inverse_sigma = fix.sigma_m.cwiseInverse();
  const Matrix3d enu_axes = enu_from_a.scale * enu_from_a.rotation.toRotationMatrix();
  const Vector3d r = enu_from_a * (a_from_b * fix.centre_in_b) - fix.position_in_enu;
  Add(inverse_sigma.cwiseProduct(r),
      inverse_sigma.asDiagonal() * enu_axes * JacobianOfPoint(a_from_b, fix.centre_in_b),
      sum);
}

Normal7 Linearise(const BridgeTerms& terms, const Sim3& a_from_b) {
  Normal7 sum;
  for (const PairTurn& turn : terms.turns) AddTurn(turn, a_from_b, sum);
  for (const BridgeSight& sight : terms.from_a) AddSightFromA(sight, a_from_b, sum);
  for (const BridgeSight& sight : terms.from_b) AddSightFromB(sight, a_from_b, sum);
  for (const BridgeFix& fix : terms.fixes) AddFix(fix, terms.enu_from_a, a_from_b, sum);
  if (terms.b_is_one_camera) sum.H(3, 3) += 1.0 / (kHeldScaleSigma * kHeldScaleSigma);
  return sum;
}

}  // namespace

FittedBridge FitBridge(const BridgeTerms& terms, const Sim3& start) {
  const auto linearise = [&](const Sim3& state) { return Linearise(terms, state); };
  FittedBridge fitted;
  fitted.a_from_b = MinimiseLevenbergMarquardt<7>(start, linearise, Move, {.max_steps = kMaxSteps});
  const Normal7 end = linearise(fitted.a_from_b);
  fitted.cost = 0.5 * end.cost;
  const Eigen::Matrix<double, 7, 7> H = end.H.selfadjointView<Eigen::Lower>();
  // Scaled to a unit diagonal, as radians and units of a differ by far.
  const Eigen::Matrix<double, 7, 1> root = H.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::Matrix<double, 7, 1> inverse = root.cwiseInverse();
  const Eigen::Matrix<double, 7, 7> covariance = inverse.asDiagonal() *
                                                 (inverse.asDiagonal() * H * inverse.asDiagonal() +
                                                  1e-12 * Eigen::Matrix<double, 7, 7>::Identity())
                                                     .inverse() *
                                                 inverse.asDiagonal();
  fitted.log_scale_sigma = std::sqrt(std::max(0.0, covariance(3, 3)));
  const Matrix3d place = covariance.bottomRightCorner<3, 3>();
  fitted.translation_sigma = std::sqrt(std::max(0.0, EigenOf<3>(place).values[2]));
  return fitted;
}

std::vector<double> SightErrors(const BridgeTerms& terms, const Sim3& a_from_b) {
  std::vector<double> errors;
  for (const BridgeSight& sight : terms.from_a) {
    const Vector3d ray = sight.cam_from_own * (a_from_b * sight.point_in_other);
    errors.push_back(AngleBetween(ray, sight.bearing) / sight.sigma_rad);
  }
  const Sim3 b_from_a = a_from_b.Inverse();
  for (const BridgeSight& sight : terms.from_b) {
    const Vector3d ray = sight.cam_from_own * (b_from_a * sight.point_in_other);
    errors.push_back(AngleBetween(ray, sight.bearing) / sight.sigma_rad);
  }
  return errors;
}

}  // namespace orbweave
