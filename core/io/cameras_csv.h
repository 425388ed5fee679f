// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// One line per image of the manifest, with a header:
/// name,x,y,z,qw,qx,qy,qz,latitude,longitude,altitude,state,
/// sigma_x,sigma_y,sigma_z,sigma_rotation_deg. x,y,z is the camera centre in the
/// world frame, the quaternion is cam_from_world with qw >= 0, state is registered, loose or
/// not_registered (then the other cells are empty). Latitude, longitude and altitude are filled
/// when `georeferenced` and the manifest has an origin. The sigmas are one standard deviation of
/// x,y,z and the rms angle of the rotation's error (PoseUncertainty), empty where unknown. Names
/// with comma, quote or line break are quoted as RFC 4180 says.
[[nodiscard]] std::string CamerasCsv(const std::map<ImageId, RegisteredImage>& images,
                                     const ImageManifest& manifest,
                                     bool georeferenced);

}  // namespace orbweave
