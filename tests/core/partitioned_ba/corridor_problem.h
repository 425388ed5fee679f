// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "core/base/random.h"
#include "core/bundle/bundle_problem.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"

namespace orbweave {

struct CorridorProblemOptions {
  CorridorShape shape = CorridorShape::kBends;
  int panoramas = 60;
  int features_per_panorama = 80;
  double outlier_share = 0.0;  ///< bearings in a random direction
  bool has_priors = false;     ///< positions of two drives with biases, and gravity
  bool has_fixed = false;      ///< one pose, and every seventh point
};

inline Eigen::Vector3d NoiseVector(Random& random, double sigma) {
  const double x = random.Normal();
  const double y = random.Normal();
  return sigma * Eigen::Vector3d(x, y, random.Normal());
}

inline void AddCorridorPriors(const Corridor& corridor, Random& random, BundleProblem& problem) {
  problem.bias_sigma_m = {2.0, 2.0};
  for (uint32_t pose = 0; pose < corridor.cams_from_world.size(); ++pose) {
    const uint32_t drive = pose % 2;
    const Eigen::Vector3d bias(drive == 0 ? 0.5 : -0.5, 0.2, 0.0);
    problem.position_priors.push_back(
        {.pose = pose,
         .position_in_world =
             corridor.cams_from_world[pose].Centre() + bias + NoiseVector(random, 0.3),
         .sigma_m = {0.5, 0.5, 1.0},
         .bias_group = drive});
    problem.direction_priors.push_back(
        {.pose = pose,
         .direction_in_cam = corridor.cams_from_world[pose].rotation * -Eigen::Vector3d::UnitZ(),
         .sigma_rad = 0.1});
  }
}

/// A street (seed 1, 0.5 px of 5400), poses off by centimetres, points by decimetres.
inline BundleProblem MakeCorridorProblem(const CorridorProblemOptions& options) {
  const Corridor corridor = MakeCorridor({.panoramas = options.panoramas,
                                          .shape = options.shape,
                                          .features_per_panorama = options.features_per_panorama});
  Random random(1);
  BundleProblem problem;
  for (const Rigid3& truth : corridor.cams_from_world) {
    const Eigen::Quaterniond R = truth.rotation * RotationFromVector(NoiseVector(random, 1e-3));
    problem.cams_from_world.push_back(
        Rigid3::FromCentre(R, truth.Centre() + NoiseVector(random, 0.02)));
  }
  for (const Eigen::Vector3d& truth : corridor.points_in_world) {
    problem.points_in_world.push_back(truth + NoiseVector(random, 0.1));
  }
  for (uint32_t pose = 0; pose < corridor.features.size(); ++pose) {
    const Features& features = corridor.features[pose];
    for (FeatureIndex f = 0; f < features.size(); ++f) {
      const bool is_outlier = random.Uniform() < options.outlier_share;
      const Eigen::Vector3d bearing =
          is_outlier ? NoiseVector(random, 1.0).normalized() : features.Bearing(f);
      problem.observations.push_back({.pose = pose,
                                      .point = corridor.point_of_feature[pose][f],
                                      .bearing = bearing,
                                      .sigma_rad = features.sigma_rad[f]});
    }
  }
  if (options.has_priors) AddCorridorPriors(corridor, random, problem);
  if (options.has_fixed) {
    problem.pose_is_fixed.assign(problem.cams_from_world.size(), 0);
    problem.pose_is_fixed[problem.cams_from_world.size() / 3] = 1;
    for (size_t i = 0; i < problem.points_in_world.size(); ++i) {
      problem.point_is_fixed.push_back(i % 7 == 0 ? 1 : 0);
      if (i % 7 == 0) problem.points_in_world[i] = corridor.points_in_world[i];
    }
  }
  return problem;
}

/// Consecutive poses in equal shares.
inline std::vector<uint32_t> ConsecutiveOwners(size_t num_poses, uint32_t num_subproblems) {
  std::vector<uint32_t> owners;
  for (size_t pose = 0; pose < num_poses; ++pose) {
    owners.push_back(static_cast<uint32_t>(pose * num_subproblems / num_poses));
  }
  return owners;
}

inline bool SameBytes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

/// Whether poses and points are equal bit for bit.
inline bool SameBytes(const BundleProblem& a, const BundleProblem& b) {
  for (size_t i = 0; i < a.cams_from_world.size(); ++i) {
    const Rigid3& x = a.cams_from_world[i];
    const Rigid3& y = b.cams_from_world[i];
    if (!SameBytes(x.translation, y.translation) || x.rotation.coeffs() != y.rotation.coeffs()) {
      return false;
    }
  }
  for (size_t i = 0; i < a.points_in_world.size(); ++i) {
    if (!SameBytes(a.points_in_world[i], b.points_in_world[i])) return false;
  }
  return true;
}

}  // namespace orbweave
