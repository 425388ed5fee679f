// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "core/io/page/job_report.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// One line per image of the job, whichever model it is in, with a header:
/// name,x,y,z,qw,qx,qy,qz,latitude,longitude,altitude,state,
/// sigma_x,sigma_y,sigma_z,sigma_rotation_deg,model,cluster,observations,residual_px.
/// x,y,z is the camera centre in the world frame of its model, the quaternion is cam_from_world
/// with qw >= 0, state is registered, loose or not_registered (then only the cluster is known).
/// Latitude, longitude and altitude are filled where the model is georeferenced and the job has an
/// origin. The sigmas are one standard deviation of x,y,z and the rms angle of the rotation's error
/// (PoseUncertainty), empty where unknown. model: N of sparse/N. residual_px: the mean angle of its
/// observations times W / 2pi, empty without observations. cluster: the one it is interior to,
/// empty where none is. Names with comma, quote or line break are quoted as RFC 4180 says.
[[nodiscard]] std::string CamerasCsv(const JobReport& report);

/// The columns from name to sigma_rotation_deg alone, for poses that are no job's.
[[nodiscard]] std::string CamerasCsv(const std::map<ImageId, RegisteredImage>& images,
                                     const ImageManifest& manifest,
                                     bool georeferenced);

}  // namespace orbweave
