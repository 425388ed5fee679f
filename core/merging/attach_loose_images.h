// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/merging/finalise_adjustment.h"
#include "core/merging/georeference/drive_errors.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Images with a GNSS position that no georeferenced world holds - no submodel registered them, or
/// no seam joins their submodel and it is not georeferenced by itself - become loose images of the
/// first world that is, at their GNSS position. They turn as the image of their drive does that
/// this world observes and is next to them in id order (of two the earlier), and what is wrong with
/// its position is taken off theirs; where there is none they stand level and look where their
/// heading prior says, or north. Nothing happens when no world is georeferenced. `drive_errors`:
/// those of that world.
void AttachLooseImages(const ImageManifest& manifest,
                       std::span<const DriveErrors> drive_errors,
                       std::vector<FinalisedWorld>& worlds);

}  // namespace orbweave
