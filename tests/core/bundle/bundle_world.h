// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/bundle/bundle_problem.h"
#include "core/geometry/rotation.h"

namespace orbweave {

struct BundleWorldOptions {
  uint32_t num_poses = 8;
  uint32_t num_points = 300;
  double spacing_m = 3.0;
  double reach_m = 15.0;     ///< a panorama sees the points nearer than this
  double sigma_rad = 1e-3;   ///< of the bearings
  double pose_error = 0.02;  ///< start error of rotations (rad) and centres (m)
  double point_error_m = 0.2;
  double outlier_share = 0.0;  ///< bearings in a random direction
  uint64_t seed = 1;
};

inline Eigen::Vector3d RandomVector(Random& random) {
  const double x = random.Normal();
  const double y = random.Normal();
  return {x, y, random.Normal()};
}

/// A street along x: panoramas every `spacing_m`, points 3-8 m to either side, seen twice or never.
/// `truth` holds poses and points without error; `start` is what a solver gets.
struct BundleWorld {
  BundleProblem truth{};
  BundleProblem start{};
};

inline BundleWorld MakeBundleWorld(const BundleWorldOptions& options) {
  Random random(options.seed);
  BundleWorld world;
  BundleProblem& truth = world.truth;
  for (uint32_t i = 0; i < options.num_poses; ++i) {
    const Eigen::Vector3d centre(
        options.spacing_m * i, 0.3 * random.Normal(), 2.0 + 0.1 * random.Normal());
    truth.cams_from_world.push_back(
        Rigid3::FromCentre(RotationFromVector(RandomVector(random)), centre));
  }
  const double length_m = options.spacing_m * options.num_poses;
  for (uint32_t i = 0; i < options.num_points; ++i) {
    const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
    const double x = random.Uniform(-2.0, length_m);
    const double y = side * random.Uniform(3.0, 8.0);
    truth.points_in_world.emplace_back(x, y, random.Uniform(0.0, 6.0));
  }
  for (uint32_t point = 0; point < options.num_points; ++point) {
    std::vector<BundleObservation> seen_by;
    for (uint32_t pose = 0; pose < options.num_poses; ++pose) {
      const Rigid3& cam_from_world = truth.cams_from_world[pose];
      const Eigen::Vector3d ray_in_cam = cam_from_world * truth.points_in_world[point];
      if (ray_in_cam.norm() > options.reach_m) continue;
      Eigen::Vector3d noisy = ray_in_cam.normalized() + options.sigma_rad * RandomVector(random);
      if (random.Uniform() < options.outlier_share) noisy = RandomVector(random);
      seen_by.push_back({.pose = pose,
                         .point = point,
                         .bearing = noisy.normalized(),
                         .sigma_rad = options.sigma_rad});
    }
    if (seen_by.size() < 2) continue;
    truth.observations.insert(truth.observations.end(), seen_by.begin(), seen_by.end());
  }
  world.start = truth;
  for (Rigid3& pose : world.start.cams_from_world) {
    const Eigen::Vector3d turn = options.pose_error * RandomVector(random);
    const Eigen::Vector3d shift = options.pose_error * RandomVector(random);
    pose = Rigid3::FromCentre(pose.rotation * RotationFromVector(turn), pose.Centre() + shift);
  }
  for (Eigen::Vector3d& point : world.start.points_in_world) {
    point += options.point_error_m * RandomVector(random);
  }
  return world;
}

}  // namespace orbweave
