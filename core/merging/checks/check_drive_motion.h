// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "drive_motion": whether a carrier can have gone the way of the model in the time that it took.
/// Pairs of a straight street see directions, not lengths: an image a house too far along
/// contradicts none, but must have been reached and left at speeds that differ too much.
///
/// Images p, i, n follow one another in a drive with capture times, after one another; at constant
/// speed i were at C_p + (C_n - C_p) dt_1 / (dt_1 + dt_2). It is off by more than a carrier can be
/// when that is further away than a dt_1 dt_2 / 2 with a = 12 m/s^2, which is beyond the grip of
/// tyres, and six times the median of all of the drive, which holds what its times are wrong by.
/// Positions that confirm it to half, and gaps of more than 20 s, are not asked. Only for models
/// in metres (`images` in east, north, up). Loose images and those without a time take no part.
/// Linear but for sorting. Value: how far the worst is off, in metres.
[[nodiscard]] CrossCheck CheckDriveMotion(const std::map<ImageId, RegisteredImage>& images,
                                          const ImageManifest& manifest);

}  // namespace orbweave
