// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/synthetic/make_street.h"

namespace orbweave {

/// A small street of rays with truth, for tests of the mapper: a walk along given camera centres
/// between two facades; every panorama sees the points within reach with noise; images up to
/// `window` apart are matched, a share of the matches wrongly.
struct RayStreetOptions {
  std::vector<Eigen::Vector3d> centres{};
  int points_per_metre = 12;
  double reach_m = 18.0;
  int window = 6;
  double noise_px = 0.5;       ///< standard deviation along each of the two tangent axes
  double outlier_share = 0.0;  ///< of the matches of each pair
  bool random_rotations = false;
  uint64_t seed = 1;
};

struct RayStreet {
  ClusterProblem problem{};
  std::vector<Rigid3> cams_from_world{};  ///< truth, per image
  /// Per image and feature: index of the scene point it shows.
  std::vector<std::vector<int>> point_of_feature{};
};

constexpr EquirectangularCamera kStreetCamera{.width_px = 5400, .height_px = 2700};

/// `count` centres along x, `spacing_m` apart.
inline std::vector<Eigen::Vector3d> StraightWalk(int count, double spacing_m) {
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < count; ++i) centres.emplace_back(i * spacing_m, 0.0, 0.0);
  return centres;
}

/// `count` centres once round a circle.
inline std::vector<Eigen::Vector3d> RoundWalk(int count, double radius_m) {
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    centres.emplace_back(radius_m * std::cos(angle), 0.0, radius_m * std::sin(angle));
  }
  return centres;
}

namespace street_internal {

/// Points scattered about the walk: at 3 to 9 metres beside, -6 to 2 metres in height (y down).
inline std::vector<Eigen::Vector3d> ScatterPoints(const RayStreetOptions& options, Random& random) {
  std::vector<Eigen::Vector3d> points;
  const auto& centres = options.centres;
  for (size_t i = 0; i < centres.size(); ++i) {
    const size_t from = i == 0 ? 0 : i - 1;
    const double step = (centres[i] - centres[from]).norm();
    const int count = std::max(2, static_cast<int>(options.points_per_metre * std::max(step, 0.5)));
    for (int k = 0; k < count; ++k) {
      const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
      const double radius = random.Uniform(3.0, 9.0);
      points.push_back(centres[i] + Eigen::Vector3d(radius * std::cos(angle),
                                                    random.Uniform(-6.0, 2.0),
                                                    radius * std::sin(angle)));
    }
  }
  return points;
}

inline Eigen::Quaterniond RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized();
}

inline Eigen::Vector3d Disturbed(const Eigen::Vector3d& bearing, double sigma_rad, Random& random) {
  const Eigen::Vector2d offset(sigma_rad * random.Normal(), sigma_rad * random.Normal());
  return (bearing + TangentBasis(bearing) * offset).normalized();
}

inline void AddImage(const RayStreetOptions& options,
                     const std::vector<Eigen::Vector3d>& points,
                     uint32_t index,
                     Random& random,
                     RayStreet& world) {
  // Drawn in any case, so that worlds that differ in this flag alone have the same noise.
  const Eigen::Quaterniond drawn = RandomRotation(random);
  const Rigid3 cam_from_world = Rigid3::FromCentre(
      options.random_rotations ? drawn : Eigen::Quaterniond::Identity(), options.centres[index]);
  const double pixel_rad = kStreetCamera.AngleFromPixels(1.0);
  ClusterImage image{.id = ImageId(index), .camera = kStreetCamera};
  std::vector<int> shown;
  for (size_t p = 0; p < points.size(); ++p) {
    const Eigen::Vector3d ray_in_world = points[p] - options.centres[index];
    if (ray_in_world.norm() > options.reach_m) continue;
    // Noise is drawn in the world, so that it does not depend on the panorama's rotation.
    const Eigen::Vector3d noisy =
        Disturbed(ray_in_world.normalized(), options.noise_px * pixel_rad, random);
    image.bearings.push_back(cam_from_world.rotation * noisy);
    image.sigma_rad.push_back(static_cast<float>(std::max(options.noise_px, 0.5) * pixel_rad));
    image.colors.push_back({static_cast<uint8_t>(p % 256), 100, 200});
    shown.push_back(static_cast<int>(p));
  }
  world.problem.images.push_back(std::move(image));
  world.point_of_feature.push_back(std::move(shown));
  world.cams_from_world.push_back(cam_from_world);
}

inline double MedianAngle(const Eigen::Vector3d& C_a,
                          const Eigen::Vector3d& C_b,
                          const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> angles;
  for (const Eigen::Vector3d& point : points)
    angles.push_back(AngleBetween(C_a - point, C_b - point));
  if (angles.empty()) return 0.0;
  std::nth_element(angles.begin(),
                   angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2),
                   angles.end());
  return angles[angles.size() / 2];
}

inline void AddPair(const RayStreetOptions& options,
                    const std::vector<Eigen::Vector3d>& points,
                    uint32_t a,
                    uint32_t b,
                    Random& random,
                    RayStreet& world) {
  std::map<int, FeatureIndex> feature_in_b;
  for (FeatureIndex f = 0; f < world.point_of_feature[b].size(); ++f) {
    feature_in_b[world.point_of_feature[b][f]] = f;
  }
  TwoViewGeometry geometry{.pair = {ImageId(a), ImageId(b)}};
  std::vector<Eigen::Vector3d> common;
  for (FeatureIndex f = 0; f < world.point_of_feature[a].size(); ++f) {
    const auto it = feature_in_b.find(world.point_of_feature[a][f]);
    if (it == feature_in_b.end()) continue;
    const bool wrong = random.Uniform() < options.outlier_share;
    const auto any = random.Index(static_cast<uint32_t>(world.point_of_feature[b].size()));
    geometry.inliers.push_back({f, wrong ? any : it->second});
    common.push_back(points[static_cast<size_t>(it->first)]);
  }
  if (geometry.inliers.size() < 15) return;
  geometry.num_putative = static_cast<uint32_t>(geometry.inliers.size());
  geometry.b_from_a = world.cams_from_world[b] * world.cams_from_world[a].Inverse();
  const double baseline = geometry.b_from_a.translation.norm();
  geometry.kind = baseline < 1e-3 ? TwoViewKind::kPureRotation : TwoViewKind::kGeneral;
  if (baseline < 1e-3) {
    geometry.b_from_a.translation.setZero();
  } else {
    geometry.b_from_a.translation /= baseline;
  }
  // Two-view estimates are good to some hundredths of a degree.
  const Eigen::Vector3d twist(random.Normal(), random.Normal(), random.Normal());
  geometry.b_from_a.rotation =
      (RotationFromVector(5e-4 * twist) * geometry.b_from_a.rotation).normalized();
  geometry.median_angle_rad = MedianAngle(options.centres[a], options.centres[b], common);
  geometry.spread = 0.5;
  world.problem.pairs.push_back(std::move(geometry));
}

}  // namespace street_internal

inline RayStreet MakeStreet(const RayStreetOptions& options) {
  Random random(options.seed);
  const std::vector<Eigen::Vector3d> points = street_internal::ScatterPoints(options, random);
  RayStreet world;
  const auto count = static_cast<uint32_t>(options.centres.size());
  for (uint32_t i = 0; i < count; ++i) street_internal::AddImage(options, points, i, random, world);
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t b = a + 1; b < count; ++b) {
      if (static_cast<int>(b - a) <= options.window) {
        street_internal::AddPair(options, points, a, b, random, world);
      }
    }
  }
  return world;
}

}  // namespace orbweave
