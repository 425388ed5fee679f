// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/features/extract_options.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Whether features of facade views are wanted of a job's images: as options.facades says; auto:
/// where GNSS has more than half of those with a position further than 4 m from all others but one,
/// and all together three of their standard deviations or more from their mean (RMS).
/// A wall 8 m away that is seen again 4 m on is tilted by 27 degrees, two panoramas on by 45, and
/// descriptors of the panorama itself are found again up to about that.
[[nodiscard]] bool WantsFacades(const ImageManifest& manifest, const ExtractOptions& options);

}  // namespace orbweave
