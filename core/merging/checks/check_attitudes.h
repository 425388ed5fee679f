// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// What cameras that stand upright, or lean as is stated, make of a model whose -z is down.
///
/// "drive_mounts": by how much the mean of down in the cameras of each drive is off their y axes,
/// after what is stated is taken off (DriveAttitudes), with its sigma (Gravity::mount_sigma_rad).
/// Never a fault; value: the largest, in degrees.
///
/// "stated_attitude", where any panorama of the model states pitch or roll: whether these agree
/// with the model. Doubtful where, in a drive that states them, pitch or roll fits clearly better
/// with the other sign (what it varies by, or its mean); where panoramas are off the drive's mean
/// by more than 3 sigma_a in the median, sigma_a^2 = stated^2 + (1 degree)^2; or where that mean is
/// off by 3 sigma_b, sigma_b^2 = stated^2 + (2 degrees)^2. The sentence says which drives' angles
/// were not used, and why. Value: the angle that is furthest off for its limit, in degrees.
///
/// Loose images take no part. Empty where panoramas are not upright on average (EstimateGravity).
[[nodiscard]] std::vector<CrossCheck> CheckAttitudes(
    const std::map<ImageId, RegisteredImage>& images, const ImageManifest& manifest);

}  // namespace orbweave
