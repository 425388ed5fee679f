// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_two_view.h"

#include <algorithm>

#include "core/estimators/pair_kernels.h"
#include "core/geometry/rotation.h"

namespace orbweave {

using Eigen::Vector3d;

static_assert(sizeof(Vector3d) == 3 * sizeof(double));

Rigid3 MoveRelativePose(const Rigid3& b_from_a, const Eigen::Matrix<double, 5, 1>& delta) {
  const Vector3d& T = b_from_a.translation;
  return {(RotationFromVector(delta.head<3>()) * b_from_a.rotation).normalized(),
          (T + TangentBasis(T) * delta.tail<2>()).normalized()};
}

Linearisation<5> LineariseEpipolarResiduals(const Rigid3& b_from_a,
                                            std::span<const Vector3d> bearings_a,
                                            std::span<const Vector3d> bearings_b,
                                            double loss_scale_rad) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = b_from_a.rotation.toRotationMatrix();
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(b_from_a.translation);
  internal::PoseTerms pose;
  std::copy_n(R.data(), pose.R.size(), pose.R.begin());
  std::copy_n(b_from_a.translation.data(), pose.T.size(), pose.T.begin());
  std::copy_n(B.data(), pose.B.size(), pose.B.begin());
  Linearisation<5> result;
  if (bearings_a.empty()) return result;
  const internal::ResidualSums sums = internal::SumEpipolarResiduals(
      pose, bearings_a[0].data(), bearings_b[0].data(), bearings_a.size(), loss_scale_rad);
  size_t entry = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) result.H(i, j) = sums.H[entry++];
    result.g[i] = sums.g[static_cast<size_t>(i)];
  }
  result.cost = sums.cost;
  return result;
}

Rigid3 MinimiseEpipolarResiduals(const Rigid3& initial,
                                 std::span<const Vector3d> bearings_a,
                                 std::span<const Vector3d> bearings_b,
                                 double loss_scale_rad,
                                 int max_steps) {
  const auto linearise = [&](const Rigid3& pose) {
    return LineariseEpipolarResiduals(pose, bearings_a, bearings_b, loss_scale_rad);
  };
  return MinimiseLevenbergMarquardt<5>(
      initial, linearise, MoveRelativePose, {.max_steps = max_steps});
}

}  // namespace orbweave
