// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_candidate.h"

namespace orbweave {

/// Takes away the heading, the pitch or the roll of all images, and warns, where three or more
/// state it, all of them the same multiple of 90 degrees to the last digit, and nobody states its
/// accuracy. Stitching programs write zeros where they do not know; as terms of the adjustment they
/// would turn the model. `candidates[i]` is images[i].
void DropSharedAngles(std::span<const IngestCandidate> candidates, ImageManifest& manifest);

}  // namespace orbweave
