// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/camera_rays.h"

#include "core/geometry/rotation.h"

namespace orbweave {

CameraRays::CameraRays(const EquirectangularCamera& camera,
                       const Rigid3& cam_from_street,
                       const LensRig& lenses,
                       const RollingShutter& shutter)
    : street_from_cam_(cam_from_street.rotation.conjugate().toRotationMatrix()),
      centre_(cam_from_street.Centre()),
      height_px_(camera.height_px),
      lenses_(lenses),
      shutter_(shutter) {}

LightRay CameraRays::Through(const Eigen::Vector3d& bearing, double row_px) const {
  LightRay ray{centre_, street_from_cam_ * bearing};
  if (lenses_.offset_m != 0.0) {
    const Eigen::Vector3d lens = lenses_.offset_m * LensRig::AxisFor(bearing);
    ray.origin += street_from_cam_ * lens;
    ray.direction = street_from_cam_ * (LensRig::kStitchedAt_m * bearing - lens).normalized();
  }
  if (shutter_.readout_s != 0.0) {
    const double late_s = (row_px / height_px_ - 0.5) * shutter_.readout_s;
    const Eigen::Quaterniond turn =
        RotationFromVector({0.0, 0.0, shutter_.yaw_rate_rad_s * late_s});
    ray.origin = centre_ + turn * (ray.origin - centre_) + late_s * shutter_.velocity_mps;
    ray.direction = turn * ray.direction;
  }
  return ray;
}

}  // namespace orbweave
