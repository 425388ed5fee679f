// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave::testing {

/// Panoramas of carriers that drove, poses exact and in east-north-up metres, with GNSS.
struct DrivenStreet {
  Reconstruction model{};
  ImageManifest manifest{};
};

struct DriveOptions {
  int panoramas = 60;
  double step_m = 3.0;
  double turn_rad = 0.0;    ///< of the heading
  double turn_share = 0.3;  ///< of the drive, in the middle, over which it turns; 1: an arc
  double sigma_m = 0.0;     ///< of GNSS, per axis
  Eigen::Quaterniond mount = Eigen::Quaterniond::Identity();  ///< from an upright camera
  bool keeps_heading = false;  ///< cameras look east wherever the carrier goes
  double sway_rad = 0.0;
  double slope_rad = 0.0;   ///< of the steepest hill, up and down
  int hill_panoramas = 40;  ///< from one hill to the next
};

/// Adds a drive that starts at the origin; its number is that of the drives before.
inline void AddDrive(const DriveOptions& options, Random& random, DrivenStreet& street) {
  const uint32_t drive =
      street.manifest.images.empty() ? 0 : street.manifest.images.back().drive + 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int i = 0; i < options.panoramas; ++i) {
    const double way = (static_cast<double>(i) / options.panoramas - 0.5) / options.turn_share;
    const double heading = 0.3 + options.turn_rad * std::clamp(way + 0.5, 0.0, 1.0);
    const double slope = options.slope_rad * std::sin(2.0 * EIGEN_PI * i / options.hill_panoramas);
    const Eigen::Vector3d right(std::sin(heading), -std::cos(heading), 0.0);
    const Eigen::Vector3d forward(
        std::cos(slope) * std::cos(heading), std::cos(slope) * std::sin(heading), std::sin(slope));
    Eigen::Matrix3d upright;  // cam_from_world
    upright.row(0) = right;
    upright.row(1) = forward.cross(right);
    upright.row(2) = forward;
    if (options.keeps_heading) {
      const double east = -heading;
      upright *= RotationFromVector({0.0, 0.0, east}).toRotationMatrix().transpose();
    }
    const Eigen::Vector3d sway(random.Normal(), random.Normal(), random.Normal());
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    const ImageId id(static_cast<uint32_t>(street.manifest.images.size()));
    street.model.images[id].cam_from_world = Rigid3::FromCentre(
        RotationFromVector(options.sway_rad * sway) * options.mount * Eigen::Quaterniond(upright),
        centre);
    ImageRecord& image = street.manifest.images.emplace_back();
    image.id = id;
    image.drive = drive;
    image.prior.position_in_enu = centre + options.sigma_m * noise;
    image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = std::max(options.sigma_m, 0.1);
    centre += options.step_m * forward;
  }
}

inline DrivenStreet Drive(const DriveOptions& options, uint64_t seed) {
  Random random(seed);
  DrivenStreet street;
  AddDrive(options, random, street);
  return street;
}

}  // namespace orbweave::testing
