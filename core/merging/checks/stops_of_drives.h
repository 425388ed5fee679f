// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"
#include "core/scene/uneven_stops.h"

namespace orbweave {

/// The images of a drive that a model holds, in its order, and where they stand.
struct StopsOfDrive {
  std::vector<ImageId> images{};
  std::vector<DriveStop> stops{};
};

/// Of each drive, in order of times, else of ids, where captures that were taken out count by their
/// numbers (CapturesAlong); loose images take no part.
[[nodiscard]] std::vector<StopsOfDrive> StopsOfDrives(
    const std::map<ImageId, RegisteredImage>& images, const ImageManifest& manifest);

}  // namespace orbweave
