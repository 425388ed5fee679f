// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/bundle/block_matrix.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/gauge.h"
#include "core/bundle/reduced_system.h"
#include "core/bundle/variance_factors.h"

namespace orbweave {

/// What is known of the errors of adjusted poses.
struct PoseCovariances {
  /// Per pose of (w, C): w (rad) turns R to R exp([w]x), so both are in world axes, C in world
  /// units. Zero for a pose that is held; nullopt for one without observations.
  std::vector<std::optional<Block6>> poses{};
  /// What the covariances are relative to: the pose that is held and the one whose distance to it
  /// is. Without an anchor they are those of the priors' frame, or of the poses the caller fixed.
  std::optional<uint32_t> anchor{};
  std::optional<uint32_t> farthest{};
  VarianceFactors factors{};
  std::string reason{};  ///< why every pose is nullopt; empty: they are not
};

/// One solve at its solution.
struct LinearisedBundle {
  const BundleProblem& problem;
  const BundleLayout& layout;
  const BundleState& state;
  const Gauge& gauge;
};

/// Covariances of the poses from the assembled system of the cameras: `bearings` holds the
/// undamped least-squares terms of all bearings, points eliminated (H_cc - H_cp H_pp^-1 H_pc),
/// no matter who formed its parts. Bearings and position priors are weighted by their variance
/// factors, direction priors and biases as the problem says; then the diagonal blocks of the
/// inverse are taken (BlockCholesky::InverseDiagonal): linear in the length of a street. A held
/// distance is exact. A system that is not positive definite, as when a panorama sees two points
/// only, is tried once more with a trace of damping, which gives what is undetermined a large
/// sigma.
///
/// The estimate weighs position priors by Cauchy's loss; the covariance is that of weights that
/// fit the variance factors. They agree where one kind of observation decides, as priors do about
/// the frame and bearings about the shape; in between the estimate may be somewhat worse.
[[nodiscard]] PoseCovariances CovariancesOfSystem(const LinearisedBundle& bundle,
                                                  const VarianceFactors& factors,
                                                  ReducedSystem bearings);

/// Covariances at the solution of `problem`, whose bearings are taken as free of outliers.
/// `biases_m`: one per bias group, from BundleReport. Same bytes for any `num_threads`.
[[nodiscard]] PoseCovariances EstimatePoseCovariances(const BundleProblem& problem,
                                                      const std::vector<Eigen::Vector3d>& biases_m,
                                                      int num_threads);

}  // namespace orbweave
