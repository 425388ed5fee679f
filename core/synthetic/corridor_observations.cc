// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_observations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/corridor_points.h"
#include "core/synthetic/corridor_terrain.h"

namespace orbweave {
namespace {

constexpr int kLenses = 5;

Eigen::Vector3d Perturbed(const Eigen::Vector3d& bearing, double sigma_rad, Random& random) {
  const Eigen::Vector2d shift(random.Normal(), random.Normal());
  return (bearing + TangentBasis(bearing) * (sigma_rad * shift)).normalized();
}

void AppendDescriptor(uint32_t appearance, std::vector<uint8_t>& descriptors) {
  Random code(0x5eedc0de00000000ULL + appearance);
  for (int k = 0; k < kDescriptorSize; ++k)
    descriptors.push_back(static_cast<uint8_t>(code.Index(90)));
}

/// What a multi-lens head sees of a point: lens k looks to azimuth 2 pi k / 5, stands `offset_m`
/// from the centre in that direction, and takes the sector about it. Stitching at infinity keeps
/// the ray's direction and forgets where it started.
Eigen::Vector3d RayOfLens(const Eigen::Vector3d& point_in_cam, double offset_m) {
  constexpr double kSector = 2.0 * std::numbers::pi / kLenses;
  const double azimuth = std::atan2(point_in_cam.x(), point_in_cam.z());
  const double lens = kSector * std::round(azimuth / kSector);
  return (point_in_cam - offset_m * Eigen::Vector3d(std::sin(lens), 0.0, std::cos(lens)))
      .normalized();
}

void AddFeature(uint32_t point,
                uint32_t appearance,
                const Eigen::Vector3d& bearing,
                const CorridorOptions& options,
                Features& features) {
  const Eigen::Vector2d pixel = features.camera.PixelFromBearing(bearing);
  features.keypoints.push_back(
      {.x_px = static_cast<float>(pixel.x()), .y_px = static_cast<float>(pixel.y())});
  features.sigma_rad.push_back(static_cast<float>(features.camera.AngleFromPixels(1.0)));
  features.colors.push_back(
      {static_cast<uint8_t>(90 + point % 120), static_cast<uint8_t>(90 + point % 97), 110});
  if (options.descriptors) AppendDescriptor(appearance, features.descriptors);
}

void Observe(uint32_t point,
             uint32_t image,
             const CorridorOptions& options,
             Random& random,
             Corridor& corridor) {
  Features& features = corridor.features[image];
  const double sigma_rad = features.camera.AngleFromPixels(options.noise_px);
  const Eigen::Vector3d ray = RayOfLens(
      corridor.cams_from_world[image] * corridor.points_in_world[point], options.lens_offset_m);
  AddFeature(point,
             corridor.appearance_of_point[point],
             Perturbed(ray, sigma_rad, random),
             options,
             features);
  corridor.point_of_feature[image].push_back(point);
}

/// Where repeated facades take their points from: cells a period apart draw the same ones, and
/// their appearance is that of the copies in the first period.
class Pattern {
 public:
  Pattern(const CorridorOptions& options, double points_per_cell)
      : seed_(static_cast<uint64_t>(options.seed) * 3 + 0xfacade),
        period_(static_cast<uint32_t>(options.repeat_after)),
        points_(period_ == 0 ? 0U : static_cast<uint32_t>(options.repeat_share * points_per_cell)),
        first_point_(period_) {}

  /// Starts a cell, whose points begin with index `first_point`.
  void Enter(const CorridorCell& cell, uint32_t index, uint32_t first_point) {
    left_ = cell.in_tunnel ? 0U : points_;
    if (left_ == 0) return;
    const uint32_t phase = index % period_;
    if (index < period_) first_point_[phase] = first_point;
    next_appearance_ = first_point_[phase];
    random_ = Random(seed_ + (static_cast<uint64_t>(phase) << 32));
  }
  [[nodiscard]] bool HasNext() const { return left_ > 0; }
  [[nodiscard]] Random& Source() { return random_; }
  uint32_t TakeAppearance() {
    --left_;
    return next_appearance_++;
  }

 private:
  uint64_t seed_;
  uint32_t period_;
  uint32_t points_;
  std::vector<uint32_t> first_point_;  // by cell of the first period
  Random random_{0};
  uint32_t left_ = 0;
  uint32_t next_appearance_ = 0;
};

/// Points per cell such that a panorama has as many features as asked.
double PointsPerCell(const CorridorOptions& options, bool in_tunnel) {
  const int features = in_tunnel ? options.tunnel_features : options.features_per_panorama;
  const double points = features / MeanViews(in_tunnel, options.spacing_m);
  // Of two drives each sees the lasting points and half of the others.
  return options.drives == 2 ? points * 2.0 / (1.0 + options.lasting_share) : points;
}

void ChooseDrives(const CorridorOptions& options, Random& random, StreetPoint& point) {
  if (options.drives < 2 || random.Uniform() < options.lasting_share) return;
  point.seen_by_first = random.Uniform() < 0.5;
  point.seen_by_second = !point.seen_by_first;
}

void AddRoof(const CorridorOptions& options, Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 0x200f);
  std::vector<Eigen::Vector3d> spots;
  for (int k = 0; k < options.roof_features; ++k) {
    const double azimuth = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double down = random.Uniform(0.7, 1.0);  // sine of the depression: below 44 degrees
    const double level = std::sqrt(1.0 - down * down);
    spots.emplace_back(level * std::sin(azimuth), down, level * std::cos(azimuth));
  }
  for (uint32_t image = 0; image < corridor.features.size(); ++image) {
    Features& features = corridor.features[image];
    const double sigma_rad = features.camera.AngleFromPixels(options.noise_px);
    for (uint32_t k = 0; k < spots.size(); ++k) {
      if (random.Uniform() >= kSeenShare) continue;
      const uint32_t name = kCarrierPoint + k;
      AddFeature(name, name, Perturbed(spots[k], sigma_rad, random), options, features);
      corridor.point_of_feature[image].push_back(name);
    }
  }
}

}  // namespace

void MakePointsAndFeatures(const CorridorOptions& options,
                           const CorridorPath& path,
                           const PlanarGrid& cameras,
                           Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 2);
  Pattern pattern(options, PointsPerCell(options, false));
  const CorridorTerrain terrain(options, path);
  double owed = 0.0;
  for (uint32_t index = 0; index < path.cells.size(); ++index) {
    const CorridorCell& cell = path.cells[index];
    pattern.Enter(cell, index, static_cast<uint32_t>(corridor.points_in_world.size()));
    for (owed += PointsPerCell(options, cell.in_tunnel); owed >= 1.0; owed -= 1.0) {
      const auto id = static_cast<uint32_t>(corridor.points_in_world.size());
      Random& source = pattern.HasNext() ? pattern.Source() : random;
      const double along_m = source.Uniform(-0.5, 0.5) * options.spacing_m;
      StreetPoint point = MakeStreetPoint(cell, along_m, source);
      ChooseDrives(options, random, point);
      const Eigen::Vector2d plan = point.position_in_world.head<2>();
      point.position_in_world.z() += terrain.HeightAt(plan);
      corridor.points_in_world.push_back(point.position_in_world);
      corridor.appearance_of_point.push_back(pattern.HasNext() ? pattern.TakeAppearance() : id);
      for (const uint32_t image : cameras.Within(plan, point.farthest_m)) {
        const CorridorStation& station = path.stations[image];
        if (!point.IsSeenFrom(station, path.cells[station.cell])) continue;
        if (random.Uniform() < kSeenShare) Observe(id, image, options, random, corridor);
      }
    }
  }
  AddRoof(options, corridor);
}

}  // namespace orbweave
