// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Puts the origin of the east-north-up frame at the rounded median of all geodetic positions and
/// fills in position_in_enu. An altitude that is not finite becomes the origin's. A position that
/// is nowhere near the others is dropped with a warning. Nothing happens without positions.
void PlaceInLocalFrame(ImageManifest& manifest);

}  // namespace orbweave
