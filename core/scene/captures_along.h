// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Which capture of its drive each image of a sequence, given in its order, is: from 0 on, as the
/// numbers in their names count them. Where somebody took one out, as people do with those that are
/// blurred, the carrier went on for two steps, and the names alone tell: 35, 37.
///
/// The number of an image is the last one in its name, without the ending. The most common
/// difference of neighbours is one capture (a video of which each tenth frame was kept counts by
/// tens), where at least half of them differ so; a multiple of it is so many. All others, as where
/// a camera begins at 1 anew, count as one, and so do all where numbers count nothing.
[[nodiscard]] std::vector<uint32_t> CapturesAlong(const ImageManifest& manifest,
                                                  std::span<const ImageId> sequence);

}  // namespace orbweave
