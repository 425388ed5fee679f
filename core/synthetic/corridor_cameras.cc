// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/corridor_cameras.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/scene/local_frame.h"
#include "core/synthetic/corridor_terrain.h"

namespace orbweave {
namespace {

constexpr double kCameraHeightM = 2.5;
constexpr double kSwayRad = 0.015;
constexpr double kTrembleRad = 2e-4;  // of a carrier that stands
constexpr double kDayS = 86400.0;
constexpr GeodeticPosition kOrigin = {22.3, 114.17, 10.0};

/// From a camera that stands upright on the carrier to one that leans with its mount.
Eigen::Quaterniond Mount(const CorridorOptions& options) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  return RotationFromVector({0.0, 0.0, -kRadPerDeg * options.mount_roll_deg}) *
         RotationFromVector({-kRadPerDeg * options.mount_pitch_deg, 0.0, 0.0});
}

/// cam_from_world of a panorama that looks along the street, up or down its slope, up to a degree
/// of sway.
Eigen::Quaterniond LookAlong(const Eigen::Vector2d& direction,
                             double slope,
                             bool any_rotation,
                             Random& random) {
  if (any_rotation) {
    Eigen::Quaterniond q(random.Normal(), random.Normal(), random.Normal(), random.Normal());
    return q.normalized();
  }
  const Eigen::Vector3d right(direction.y(), -direction.x(), 0.0);
  const Eigen::Vector3d forward = Eigen::Vector3d(direction.x(), direction.y(), slope).normalized();
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(0) = right;
  cam_from_world.row(1) = forward.cross(right);  // down
  cam_from_world.row(2) = forward;
  const Eigen::Vector3d sway =
      Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()) * kSwayRad;
  return (RotationFromVector(sway) * Eigen::Quaterniond(cam_from_world)).normalized();
}

std::string ImageName(size_t i) {
  const std::string number = std::to_string(i);
  return "pano_" + std::string(6 - std::min<size_t>(6, number.size()), '0') + number + ".jpg";
}

Eigen::Vector3d HorizontalVector(double length_m, Random& random) {
  const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
  return length_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
}

/// What all positions of a drive, or of the stretch that jumped, have in common.
struct GnssOffsets {
  std::array<Eigen::Vector3d, 2> of_drive{};
  Eigen::Vector3d of_jump = Eigen::Vector3d::Zero();
  size_t jump_begin = 0;
  size_t jump_end = 0;

  GnssOffsets(const CorridorOptions& options, size_t num_panoramas) {
    Random random(static_cast<uint64_t>(options.seed) * 3 + 0x6e55);
    for (Eigen::Vector3d& bias : of_drive) bias = HorizontalVector(options.gnss_bias_m, random);
    of_drive[1].z() = options.gnss_datum_m;
    of_jump = HorizontalVector(options.gnss_jump_m, random);
    const size_t length = std::min(static_cast<size_t>(options.gnss_jump_panoramas), num_panoramas);
    jump_begin = (num_panoramas - length) / 2;
    jump_end = jump_begin + length;
  }

  [[nodiscard]] Eigen::Vector3d At(size_t i, uint32_t drive) const {
    const bool jumped = i >= jump_begin && i < jump_end;
    return jumped ? Eigen::Vector3d(of_drive[drive] + of_jump) : of_drive[drive];
  }
};

/// Noise of one position after the other, of unit variance: independent, or correlated with that of
/// the panorama before as exp(-distance / correlation) (Ornstein-Uhlenbeck).
class GnssNoise {
 public:
  explicit GnssNoise(double correlation_m) : correlation_m_(correlation_m) {}

  Eigen::Vector3d Next(const CorridorStation& station, Random& random) {
    const Eigen::Vector3d fresh(random.Normal(), random.Normal(), random.Normal());
    double kept = 0.0;
    if (correlation_m_ > 0.0 && last_ != nullptr && last_->drive == station.drive) {
      const double step_m = (station.place.position - last_->place.position).norm();
      kept = std::exp(-step_m / correlation_m_);
    }
    noise_ = kept * noise_ + std::sqrt(1.0 - kept * kept) * fresh;
    last_ = &station;
    return noise_;
  }

 private:
  double correlation_m_;
  Eigen::Vector3d noise_ = Eigen::Vector3d::Zero();
  const CorridorStation* last_ = nullptr;
};

/// The carrier slows down and hurries on, as from one light to the next.
double SpeedAt(const CorridorOptions& options, size_t i) {
  constexpr double kWave_m = 120.0;
  const double phase =
      2.0 * std::numbers::pi * static_cast<double>(i) * options.spacing_m / kWave_m;
  return options.speed_m_per_s * (1.0 + options.speed_spread * std::sin(phase));
}

/// Where the antenna was when the receiver measured what it says of station i; a drive came
/// straight from where it begins and goes straight on from where it ends.
Eigen::Vector2d AntennaPlace(const CorridorOptions& options, const CorridorPath& path, size_t i) {
  const std::vector<CorridorStation>& stations = path.stations;
  const double behind = options.gnss_delay_s * SpeedAt(options, i) / options.spacing_m;
  const double whole = std::floor(behind);
  const auto place = [&](double steps) {
    size_t at = i;
    for (; steps >= 1.0 && at > 0 && stations[at - 1].drive == stations[i].drive; --steps) --at;
    for (; steps < 0.0 && at + 1 < stations.size() && stations[at + 1].drive == stations[i].drive;
         ++steps)
      ++at;
    const PathPlace& nearest = stations[at].place;
    return Eigen::Vector2d(nearest.position - steps * options.spacing_m * nearest.direction);
  };
  const double rest = behind - whole;
  return (1.0 - rest) * place(whole) + rest * place(whole + 1.0) +
         options.gnss_left_m * stations[i].place.Left();
}

PosePrior MakePrior(const Eigen::Vector3d& biased_centre,
                    const Eigen::Vector3d& noise,
                    const CorridorOptions& options,
                    Random& random) {
  PosePrior prior{.horizontal_sigma_m = options.gnss_sigma_m,
                  .vertical_sigma_m = 2.0 * options.gnss_sigma_m};
  Eigen::Vector3d position = biased_centre;
  position += options.gnss_sigma_m * Eigen::Vector3d(noise.x(), noise.y(), 2.0 * noise.z());
  if (random.Uniform() < options.gnss_outlier_share) {
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    position +=
        random.Uniform(20.0, 100.0) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  }
  if (!options.gnss_heights) {
    position.z() = 0.0;
    prior.vertical_sigma_m = kUnknownHeightSigma_m;
  }
  prior.geodetic = GeodeticFromEnu(position, kOrigin);
  prior.position_in_enu = position;
  return prior;
}

/// Whether the receiver still says of station i what it said of the one before.
bool IsHeld(const CorridorOptions& options, const CorridorPath& path, size_t i) {
  return i % static_cast<size_t>(options.gnss_held_panoramas) != 0 &&
         path.stations[i].drive == path.stations[i - 1].drive;
}

}  // namespace

void MakeCameras(const CorridorOptions& options, const CorridorPath& path, Corridor& corridor) {
  Random random(static_cast<uint64_t>(options.seed) * 3 + 1);
  const GnssOffsets offsets(options, path.stations.size());
  const EquirectangularCamera camera{options.width_px, options.width_px / 2};
  if (options.gnss_sigma_m > 0.0) corridor.manifest.origin = kOrigin;
  const Eigen::Quaterniond mount = Mount(options);
  const CorridorTerrain terrain(options, path);
  GnssNoise noise(options.gnss_correlation_m);
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  // of the carrier that moved last
  const bool is_timed = options.gnss_delay_s != 0.0 || options.speed_spread != 0.0;
  double time_s = 0.0;
  for (size_t i = 0; i < path.stations.size(); ++i) {
    const CorridorStation& station = path.stations[i];
    const Eigen::Vector2d& plan = station.place.position;
    const Eigen::Vector3d centre(plan.x(), plan.y(), terrain.HeightAt(plan) + kCameraHeightM);
    if (!station.standing) {
      const Eigen::Vector2d& direction = station.place.direction;
      attitude =
          mount *
          LookAlong(direction, terrain.SlopeAt(plan, direction), options.random_rotations, random);
    }
    Eigen::Quaterniond cam_from_world = attitude;
    if (station.standing) {
      const Eigen::Vector3d tremble(random.Normal(), random.Normal(), random.Normal());
      cam_from_world = (RotationFromVector(kTrembleRad * tremble) * attitude).normalized();
    }
    corridor.cams_from_world.push_back(Rigid3::FromCentre(cam_from_world, centre));
    ImageRecord image{.id = ImageId(static_cast<uint32_t>(i)),
                      .name = ImageName(i),
                      .camera = camera,
                      .drive = station.drive};
    if (options.gnss_sigma_m > 0.0) {
      const Eigen::Vector2d antenna = AntennaPlace(options, path, i);
      const Eigen::Vector3d measured(antenna.x(), antenna.y(), centre.z());
      image.prior = MakePrior(
          measured + offsets.At(i, station.drive), noise.Next(station, random), options, random);
    }
    if (IsHeld(options, path, i)) image.prior = corridor.manifest.images.back().prior;
    if (options.drives == 2 || is_timed) image.capture_time_s = kDayS * station.drive + time_s;
    const double speed = 0.5 * (SpeedAt(options, i) + SpeedAt(options, i + 1));
    time_s += is_timed ? options.spacing_m / speed : 1.0;
    corridor.manifest.images.push_back(std::move(image));
    corridor.features.push_back({.camera = camera});
  }
  corridor.point_of_feature.resize(path.stations.size());
}

}  // namespace orbweave
