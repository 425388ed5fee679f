// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct FilteredReconstruction {
  Reconstruction reconstruction{};
  uint32_t removed_observations = 0;  ///< those of removed tracks included
  uint32_t removed_tracks = 0;
};

/// Removes observations whose ray is more than max_error_px (at the equator of the image's camera,
/// (8)) from their bearing, and so those behind it, and observations of images that are loose or
/// not registered; then tracks with fewer than two observations or no two rays at min_angle_rad or
/// more. What remains stays sorted.
[[nodiscard]] FilteredReconstruction FilterObservations(Reconstruction reconstruction,
                                                        const ImageManifest& manifest,
                                                        double max_error_px,
                                                        double min_angle_rad);

}  // namespace orbweave
