// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "stated_heading": whether the headings that drives state agree with a model whose -z is down.
///
/// Of each drive with ten or more: d_i = stated - atan2(east, north) of where image i looks.
/// Doubtful where the d_i are off their median by more than 3 sigma in the median, sigma^2 =
/// stated^2 + (1 degree)^2, headings clearly fitting better counter-clockwise among them. All alike
/// off, by more than 3 sigma in a georeferenced model, they are those of another thing than the
/// image centre or of another north: said, and good, as the model is not made of them. Value: the
/// angle that is furthest off for its limit, in degrees.
///
/// Loose images take no part. Absent where no drive states so many.
[[nodiscard]] std::optional<CrossCheck> CheckHeadings(
    const std::map<ImageId, RegisteredImage>& images,
    const ImageManifest& manifest,
    bool is_georeferenced);

}  // namespace orbweave
