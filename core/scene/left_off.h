// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Behind which images of a sequence, given by their priors in its order, the drive was left off by
/// GNSS and taken up elsewhere: a stretch is of another day, or was removed. Those beside the gap
/// do not see the same, and are no neighbours.
///
/// A gap is a step of more than three usual ones (the median of those of a camera that does not
/// stand) and three standard deviations, horizontally. The next position before it and the one
/// behind it must be as far from the other side: a single position that is off makes no gap. None
/// beside an image without a position, and behind the last image.
[[nodiscard]] std::vector<uint8_t> LeftOffBehind(std::span<const PosePrior* const> sequence);

/// The same of images in the order of their drive, which may have times. After a pause, an interval
/// of more than three usual ones, a step of more than two usual ones is a gap whatever the sigmas:
/// a camera that stood for a while goes on where it stood, and that a single position makes the gap
/// shorter hides it no longer.
[[nodiscard]] std::vector<uint8_t> LeftOffBehind(const ImageManifest& manifest,
                                                 std::span<const ImageId> sequence);

}  // namespace orbweave
