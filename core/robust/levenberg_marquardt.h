// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace orbweave {

/// Gauss-Newton approximation of a cost at some state: cost(state + delta) ~
/// cost + 2 g.delta + delta^T H delta, with weights of the loss in H and g.
template <int N>
struct Linearisation {
  Eigen::Matrix<double, N, N> H = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> g = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0.0;

  /// One scalar residual r with its row of the Jacobian and its weight.
  void Add(double r, const Eigen::Matrix<double, N, 1>& J, double weight) {
    H.template selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
    g += (weight * r) * J;
  }
};

struct LevenbergMarquardtOptions {
  int max_steps = 10;
  double min_relative_decrease =
      1e-6;                       ///< a smaller predicted decrease of the cost ends the search
  double initial_damping = 1e-6;  ///< relative to the diagonal of H
};

/// Levenberg-Marquardt for a handful of unknowns (a pose).
///   linearise(state) -> Linearisation<N> (lower triangle of H), add(state, delta) -> State.
/// Returns the best state seen; the start when no step helps or H is singular.
template <int N, typename State, typename Linearise, typename Add>
State MinimiseLevenbergMarquardt(State state,
                                 const Linearise& linearise,
                                 const Add& add,
                                 const LevenbergMarquardtOptions& options = {}) {
  Linearisation<N> current = linearise(state);
  double damping = options.initial_damping;
  for (int step = 0; step < options.max_steps; ++step) {
    Eigen::Matrix<double, N, N> H = current.H;
    H.diagonal() *= 1.0 + damping;
    const Eigen::LDLT<Eigen::Matrix<double, N, N>, Eigen::Lower> ldlt(H);
    const Eigen::Matrix<double, N, 1> delta = -ldlt.solve(current.g);
    if (!delta.allFinite()) return state;
    if (-current.g.dot(delta) <= options.min_relative_decrease * current.cost) return state;
    const State candidate = add(state, delta);
    const Linearisation<N> next = linearise(candidate);
    if (!(next.cost < current.cost)) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    state = candidate;
    current = next;
    damping *= 0.1;
  }
  return state;
}

}  // namespace orbweave
