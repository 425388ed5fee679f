// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/corridor_path.h"
#include "core/synthetic/geodetic_from_enu.h"
#include "core/synthetic/planar_grid.h"

namespace orbweave {
namespace {

constexpr double kCameraHeightM = 2.5;
constexpr double kSeenShare = 0.9;  // of the panoramas within a point's range
constexpr double kMinRangeM = 6.0;  // along the street
constexpr double kMaxRangeM = 14.0;
constexpr double kMeetingRadiusM = 20.0;
constexpr size_t kMinMatches = 15;
constexpr GeodeticPosition kOrigin = {22.3, 114.17, 10.0};

struct StreetPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double range_m = 0.0;  // farthest camera that sees it, in the plane
};

/// Facades on both sides, ground and clutter near the path at `place`.
StreetPoint MakePoint(const PathPlace& place, double along_m, Random& random) {
  const double kind = random.Uniform();
  const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
  double lateral_m = side * random.Uniform(8.0, 15.0);
  double height_m = random.Uniform(0.0, 15.0);
  if (kind > 0.85) {  // clutter: parked cars, poles, signs
    lateral_m = side * random.Uniform(3.0, 8.0);
    height_m = random.Uniform(0.0, 3.0);
  } else if (kind > 0.75) {  // ground
    lateral_m = side * random.Uniform(1.5, 8.0);
    height_m = 0.0;
  }
  const Eigen::Vector2d ground =
      place.position + along_m * place.direction + lateral_m * place.Left();
  const double range_m = std::hypot(lateral_m, random.Uniform(kMinRangeM, kMaxRangeM));
  return {{ground.x(), ground.y(), height_m}, range_m};
}

/// cam_from_world of a panorama that looks along the street, up to a degree of sway.
Eigen::Quaterniond LookAlong(const Eigen::Vector2d& direction, bool any_rotation, Random& random) {
  if (any_rotation) {
    Eigen::Quaterniond q(random.Normal(), random.Normal(), random.Normal(), random.Normal());
    return q.normalized();
  }
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(0) = Eigen::Vector3d(direction.y(), -direction.x(), 0.0);  // right
  cam_from_world.row(1) = -Eigen::Vector3d::UnitZ();                            // down
  cam_from_world.row(2) = Eigen::Vector3d(direction.x(), direction.y(), 0.0);   // forward
  const Eigen::Vector3d sway =
      Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()) * 0.015;
  return (RotationFromVector(sway) * Eigen::Quaterniond(cam_from_world)).normalized();
}

Eigen::Vector3d Perturbed(const Eigen::Vector3d& bearing, double sigma_rad, Random& random) {
  const Eigen::Vector2d shift(random.Normal(), random.Normal());
  return (bearing + TangentBasis(bearing) * (sigma_rad * shift)).normalized();
}

void AppendDescriptor(uint32_t point, std::vector<uint8_t>& descriptors) {
  Random code(0x5eedc0de00000000ULL + point);
  for (int k = 0; k < kDescriptorSize; ++k)
    descriptors.push_back(static_cast<uint8_t>(code.Index(90)));
}

std::string ImageName(size_t i) {
  const std::string number = std::to_string(i);
  return "pano_" + std::string(6 - std::min<size_t>(6, number.size()), '0') + number + ".jpg";
}

PosePrior MakePrior(const Eigen::Vector3d& centre, const CorridorOptions& options, Random& random) {
  PosePrior prior{.horizontal_sigma_m = options.gnss_sigma_m,
                  .vertical_sigma_m = 2.0 * options.gnss_sigma_m};
  Eigen::Vector3d position = centre;
  position += options.gnss_sigma_m *
              Eigen::Vector3d(random.Normal(), random.Normal(), 2.0 * random.Normal());
  if (random.Uniform() < options.gnss_outlier_share) {
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    position +=
        random.Uniform(20.0, 100.0) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  }
  prior.geodetic = GeodeticFromEnu(kOrigin, position);
  prior.position_in_enu = position;
  return prior;
}

void MakeCameras(const CorridorOptions& options,
                 const std::vector<PathPlace>& places,
                 Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 1);
  const EquirectangularCamera camera{options.width_px, options.width_px / 2};
  if (options.gnss_sigma_m > 0.0) corridor.manifest.origin = kOrigin;
  for (size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d centre(places[i].position.x(), places[i].position.y(), kCameraHeightM);
    corridor.cams_from_world.push_back(Rigid3::FromCentre(
        LookAlong(places[i].direction, options.random_rotations, random), centre));
    ImageRecord image{
        .id = ImageId(static_cast<uint32_t>(i)), .name = ImageName(i), .camera = camera};
    if (options.gnss_sigma_m > 0.0) image.prior = MakePrior(centre, options, random);
    corridor.manifest.images.push_back(std::move(image));
    corridor.features.push_back({.camera = camera});
  }
  corridor.point_of_feature.resize(places.size());
}

void Observe(uint32_t point,
             uint32_t image,
             const CorridorOptions& options,
             Random& random,
             Corridor& corridor) {
  Features& features = corridor.features[image];
  const double sigma_rad = features.camera.AngleFromPixels(options.noise_px);
  const Eigen::Vector3d ray =
      (corridor.cams_from_world[image] * corridor.points_in_world[point]).normalized();
  const Eigen::Vector2d pixel = features.camera.PixelFromBearing(Perturbed(ray, sigma_rad, random));
  features.keypoints.push_back(
      {.x_px = static_cast<float>(pixel.x()), .y_px = static_cast<float>(pixel.y())});
  features.sigma_rad.push_back(static_cast<float>(features.camera.AngleFromPixels(1.0)));
  features.colors.push_back(
      {static_cast<uint8_t>(90 + point % 120), static_cast<uint8_t>(90 + point % 97), 110});
  if (options.descriptors) AppendDescriptor(point, features.descriptors);
  corridor.point_of_feature[image].push_back(point);
}

/// Points in order along the street, each seen by the panoramas in its range.
void MakePointsAndFeatures(const CorridorOptions& options,
                           const std::vector<PathPlace>& places,
                           const PlanarGrid& cameras,
                           Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 2);
  const double mean_views = kSeenShare * (kMinRangeM + kMaxRangeM) / options.spacing_m;
  const double points_per_place = options.features_per_panorama / std::max(1.0, mean_views);
  double owed = 0.0;
  for (const PathPlace& place : places) {
    for (owed += points_per_place; owed >= 1.0; owed -= 1.0) {
      const double along_m = random.Uniform(-0.5, 0.5) * options.spacing_m;
      const StreetPoint point = MakePoint(place, along_m, random);
      const auto id = static_cast<uint32_t>(corridor.points_in_world.size());
      corridor.points_in_world.push_back(point.position);
      for (const uint32_t image : cameras.Within(point.position.head<2>(), point.range_m)) {
        if (random.Uniform() < kSeenShare) Observe(id, image, options, random, corridor);
      }
    }
  }
}

/// Features of the same points; both lists ascend.
std::vector<FeatureMatch> CommonFeatures(const std::vector<uint32_t>& a,
                                         const std::vector<uint32_t>& b) {
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j])
      matches.push_back({i++, j++});
    else if (a[i] < b[j])
      ++i;
    else
      ++j;
  }
  return matches;
}

constexpr int kDrawsForAFreeFeature = 50;

/// Turns a share of true matches into what a matcher would have got wrong: a feature of a joined
/// with a random one of b that is not matched yet.
void AddWrongMatches(double share,
                     size_t features_in_b,
                     Random& random,
                     std::vector<FeatureMatch>& matches) {
  std::vector<uint8_t> taken(features_in_b, 0);
  for (const FeatureMatch& match : matches) taken[match.b] = 1;
  for (FeatureMatch& match : matches) {
    if (random.Uniform() >= share) continue;
    uint32_t wrong = match.b;
    for (int draw = 0; draw < kDrawsForAFreeFeature && taken[wrong]; ++draw) {
      wrong = random.Index(static_cast<uint32_t>(features_in_b));
    }
    if (taken[wrong]) continue;
    taken[match.b] = 0;
    taken[wrong] = 1;
    match.b = wrong;
  }
}

void MakePairs(const CorridorOptions& options, const PlanarGrid& cameras, Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 3);
  const auto n = static_cast<uint32_t>(corridor.cams_from_world.size());
  for (uint32_t a = 0; a < n; ++a) {
    std::vector<uint32_t> partners =
        cameras.Within(corridor.cams_from_world[a].Centre().head<2>(), kMeetingRadiusM);
    for (uint32_t b = a + 1; b < n && b <= a + static_cast<uint32_t>(options.match_window); ++b)
      partners.push_back(b);
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    for (const uint32_t b : partners) {
      if (b <= a) continue;
      PairMatches pair{{ImageId(a), ImageId(b)},
                       CommonFeatures(corridor.point_of_feature[a], corridor.point_of_feature[b])};
      if (pair.matches.size() < kMinMatches) continue;
      AddWrongMatches(options.outlier_share, corridor.features[b].size(), random, pair.matches);
      corridor.pairs.push_back(std::move(pair));
    }
  }
}

}  // namespace

Corridor MakeCorridor(const CorridorOptions& options) {
  const std::vector<PathPlace> places = CorridorPlaces(options);
  std::vector<Eigen::Vector2d> positions;
  for (const PathPlace& place : places) positions.push_back(place.position);
  const PlanarGrid cameras(positions, kMeetingRadiusM);
  Corridor corridor;
  MakeCameras(options, places, corridor);
  MakePointsAndFeatures(options, places, cameras, corridor);
  MakePairs(options, cameras, corridor);
  return corridor;
}

}  // namespace orbweave
