// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "camera_leans": whether panoramas of a drive stand as upright as most of it. Carriers keep level
/// but for slopes; what pairs have wrong in pitch adds up along a street, which then climbs or
/// leans, and no residual tells. Down is that of the model (EstimateGravity), seen from the cameras
/// of a drive, what they state of their pitch and roll taken off (AttitudesOfDrives); a panorama
/// leans by its angle to the drive's mean, which those that lean far hardly move (Cauchy).
///
/// Value: the largest lean, deg. Doubtful from ten degrees on, a slope of 18 %, or from five times
/// the median. Without a verdict where the median is more than five degrees, as of a camera that
/// was held by hand, or panoramas are not upright on average.
[[nodiscard]] CrossCheck CheckLeans(const std::map<ImageId, RegisteredImage>& images,
                                    const ImageManifest& manifest);

}  // namespace orbweave
