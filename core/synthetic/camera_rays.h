// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rigid3.h"
#include "core/synthetic/lens_rig.h"
#include "core/synthetic/solid.h"

namespace orbweave {

/// Rows are exposed one after the other while the carrier drives on. Row v of H is exposed
/// (v / H - 1/2) readout_s after the middle of the exposure, to which a panorama's pose belongs.
struct RollingShutter {
  double readout_s = 0.0;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< in the street's frame
  double yaw_rate_rad_s = 0.0;                             ///< about the street's vertical
};

/// The rays along which a panorama sees the street.
class CameraRays {
 public:
  CameraRays(const EquirectangularCamera& camera,
             const Rigid3& cam_from_street,
             const LensRig& lenses,
             const RollingShutter& shutter);

  /// Ray in the street's frame of a position (column, row) of the panorama with its `bearing`.
  [[nodiscard]] LightRay Through(const Eigen::Vector3d& bearing, double row_px) const;

 private:
  Eigen::Matrix3d street_from_cam_;
  Eigen::Vector3d centre_;
  int height_px_;
  LensRig lenses_;
  RollingShutter shutter_;
};

}  // namespace orbweave
