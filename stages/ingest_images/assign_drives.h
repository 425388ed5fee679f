// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_candidate.h"

namespace orbweave {

/// The capture time of every image: those of the table or those of EXIF, whichever more images have
/// (the table's where it is even). Clocks are not mixed, as one may be local time, the other UTC:
/// an image that has the other's time alone has none.
/// `candidates[i]` is images[i].
void SetCaptureTimes(std::span<const IngestCandidate> candidates, ImageManifest& manifest);

/// Numbers drives by their first image: one per label of the table's drive column. A table need not
/// have a row for every image: of those of a folder, by name, that have no label the ones between
/// two images of one label are of that drive, and so are as many at most before its first and
/// behind its last. Other images without a label are gone through in the order of OrderByTime, and
/// a pause of more than `gap_s` between two of them begins a new drive. Where the times of two
/// folders overlap, two cameras were on the way at once: then every folder is gone through by
/// itself. Images whose place neither times nor names tell become a warning.
void AssignDrives(std::span<const IngestCandidate> candidates,
                  double gap_s,
                  ImageManifest& manifest);

}  // namespace orbweave
