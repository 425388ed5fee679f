// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "even_steps": whether panoramas stand where the even steps of their drive have them
/// (FindUnevenStops), as far as positions do not bear them out elsewhere (IsBorneOut). Where
/// windows repeat, one that stands a window or a house off has points that agree and a step that is
/// too long, and behind it one that is too short. Of three rendered streets 12 m apart without
/// GNSS, in which one or two panoramas stood 4 to 12 m off, nothing else spoke. Drives in order of
/// times, else of ids, where captures that were taken out count by their numbers (CapturesAlong);
/// loose panoramas take no part.
///
/// Value: by how many steps the worst is off; 0 where none is.
[[nodiscard]] CrossCheck CheckEvenSteps(const std::map<ImageId, RegisteredImage>& images,
                                        const ImageManifest& manifest);

}  // namespace orbweave
