// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "vanished_steps": whether a step of an even drive leads hardly anywhere (FindVanishedSteps), as
/// far as positions do not bear that out (IsBorneOut). Drives and their order: StopsOfDrives.
///
/// Value: how many steps the worst is short, up to one; 0 where none is.
[[nodiscard]] CrossCheck CheckVanishedSteps(const std::map<ImageId, RegisteredImage>& images,
                                            const ImageManifest& manifest);

}  // namespace orbweave
