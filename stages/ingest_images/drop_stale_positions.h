// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/scene/image_manifest.h"

namespace orbweave {

/// What positions of one drive repeat to the last digit is no new measurement: a receiver that
/// reports less often than pictures are taken, one that has lost its satellites, or a carrier that
/// stands. Of each row of them the first is kept, which is the least late; all of them would pull a
/// model back along the street, or count one error as many. A warning names the others. Images of
/// one and the same time share their position by right.
///
/// Where all positions are rounded, to a metre or more, those that repeat are as good as others:
/// they are kept, and their horizontal sigmas grow by what rounding adds, a twelfth of its square.
///
/// Drives are known, and positions in the local frame.
void DropStalePositions(ImageManifest& manifest);

}  // namespace orbweave
