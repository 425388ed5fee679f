// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/corridor.h"
#include "core/synthetic/corridor_path.h"

namespace orbweave {

/// Fills `corridor.manifest` and `cams_from_world`, and gives every image features without any
/// keypoint. Panoramas look along the street up to a degree of sway and the lean of their mount, or
/// anywhere. GNSS: noise, independent or correlated along the street; a clock that is late, an
/// antenna beside the camera; an offset of the drive, heights of the second over another datum;
/// outliers, and a stretch of positions that jumped together.
void MakeCameras(const CorridorOptions& options, const CorridorPath& path, Corridor& corridor);

}  // namespace orbweave
