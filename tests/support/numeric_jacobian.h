// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

namespace orbweave {

/// Central differences of f at x, for comparison with an analytic Jacobian: column j is
/// (f(x + h e_j) - f(x - h e_j)) / 2h.
inline Eigen::MatrixXd NumericJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
    const Eigen::VectorXd& x,
    double step = 1e-6) {
  Eigen::MatrixXd jacobian(f(x).size(), x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd h = step * Eigen::VectorXd::Unit(x.size(), j);
    jacobian.col(j) = (f(x + h) - f(x - h)) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace orbweave
