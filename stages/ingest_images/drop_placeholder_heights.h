// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_candidate.h"

namespace orbweave {

/// Takes away heights that were never measured, and warns: the one that all positions share to the
/// last digit, where there are three or more; and nought, where three or more state it and others
/// lie ten metres or more from it in the median. Programs write them where they know none; as
/// heights they lay a hilly street flat. Kept where the table states a vertical accuracy.
/// `candidates[i]` is images[i], whose altitudes are as they were stated.
void DropPlaceholderHeights(std::span<const IngestCandidate> candidates, ImageManifest& manifest);

}  // namespace orbweave
