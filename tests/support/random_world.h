// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rigid3.h"
#include "core/geometry/rotation.h"

/// Worlds for tests: random directions, rotations, points and the rays that see them.
namespace orbweave::testing {

/// Uniform on the unit sphere.
inline Eigen::Vector3d RandomDirection(Random& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Uniform on SO(3).
inline Eigen::Quaterniond RandomRotation(Random& random) {
  const double w = random.Normal();
  const double x = random.Normal();
  const double y = random.Normal();
  const double z = random.Normal();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

/// A point in a shell round the origin, all directions alike.
inline Eigen::Vector3d RandomPoint(Random& random, double min_distance, double max_distance) {
  return random.Uniform(min_distance, max_distance) * RandomDirection(random);
}

/// The bearing turned by normal noise of sigma_rad along each of two tangent directions.
inline Eigen::Vector3d WithNoise(Random& random, const Eigen::Vector3d& bearing, double sigma_rad) {
  const double a = random.Normal();
  const double b = random.Normal();
  return (bearing + TangentBasis(bearing) * (sigma_rad * Eigen::Vector2d(a, b))).normalized();
}

/// Unit bearing at which a camera sees a point.
inline Eigen::Vector3d BearingOf(const Rigid3& cam_from_world,
                                 const Eigen::Vector3d& point_in_world) {
  return (cam_from_world * point_in_world).normalized();
}

/// Angle in radians between two rotations.
inline double RotationError(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return RotationAngle(a * b.conjugate());
}

/// Two panoramas a unit baseline apart, turned at random, in a shell of points all round them; the
/// first round(count * outlier_share) matches are random in image b.
struct TwoViewWorld {
  Rigid3 b_from_a{};
  std::vector<Eigen::Vector3d> points_in_a{};
  std::vector<Eigen::Vector3d> bearings_a{};
  std::vector<Eigen::Vector3d> bearings_b{};
  size_t num_outliers = 0;
};

inline TwoViewWorld MakeTwoViewWorld(uint64_t seed,
                                     size_t count,
                                     double outlier_share = 0.0,
                                     double sigma_rad = 0.0) {
  Random random(seed);
  TwoViewWorld world;
  world.b_from_a = {RandomRotation(random), RandomDirection(random)};
  world.num_outliers = static_cast<size_t>(std::lround(outlier_share * static_cast<double>(count)));
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d X = RandomPoint(random, 2.0, 10.0);
    world.points_in_a.push_back(X);
    world.bearings_a.push_back(WithNoise(random, X.normalized(), sigma_rad));
    const Eigen::Vector3d seen = BearingOf(world.b_from_a, X);
    world.bearings_b.push_back(i < world.num_outliers ? RandomDirection(random)
                                                      : WithNoise(random, seen, sigma_rad));
  }
  return world;
}

/// A panorama with random pose amid points all round it; the first round(count * outlier_share)
/// bearings are random.
struct ResectionWorld {
  Rigid3 cam_from_world{};
  std::vector<Eigen::Vector3d> points_in_world{};
  std::vector<Eigen::Vector3d> bearings{};
  size_t num_outliers = 0;
};

inline ResectionWorld MakeResectionWorld(uint64_t seed,
                                         size_t count,
                                         double outlier_share = 0.0,
                                         double sigma_rad = 0.0) {
  Random random(seed);
  ResectionWorld world;
  const Eigen::Vector3d centre = RandomPoint(random, 0.0, 20.0);
  world.cam_from_world = Rigid3::FromCentre(RandomRotation(random), centre);
  world.num_outliers = static_cast<size_t>(std::lround(outlier_share * static_cast<double>(count)));
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d P = centre + RandomPoint(random, 2.0, 30.0);
    world.points_in_world.push_back(P);
    const Eigen::Vector3d seen = BearingOf(world.cam_from_world, P);
    world.bearings.push_back(i < world.num_outliers ? RandomDirection(random)
                                                    : WithNoise(random, seen, sigma_rad));
  }
  return world;
}

/// Panoramas round one point that all see it.
struct TrackWorld {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  std::vector<Rigid3> cams_from_world{};
  std::vector<Eigen::Vector3d> bearings{};
};

inline TrackWorld MakeTrackWorld(uint64_t seed, size_t count, double sigma_rad = 0.0) {
  Random random(seed);
  TrackWorld world;
  world.point_in_world = RandomPoint(random, 0.0, 100.0);
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d centre = world.point_in_world + RandomPoint(random, 3.0, 12.0);
    world.cams_from_world.push_back(Rigid3::FromCentre(RandomRotation(random), centre));
    world.bearings.push_back(WithNoise(
        random, BearingOf(world.cams_from_world.back(), world.point_in_world), sigma_rad));
  }
  return world;
}

}  // namespace orbweave::testing
