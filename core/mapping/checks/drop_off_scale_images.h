// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Images of a model that stand on a scale of their own, in order of registration.
///
/// A wrong pair bends a street until it fits; where nothing gives, an adjustment gets rid of what
/// contradicts it by shrinking one side to nothing: from a single place all points of the other
/// side fit, as far as it is turned. Both sides keep hundreds of points in common, the residuals
/// are as small as ever, and all that is registered later goes on on the wrong scale. In rendered
/// streets of 24 panoramas 12 m apart (docs/hard_cases.md) up to half of a model stood on a 150th
/// to a millionth of the scale of the rest.
///
/// Of an image its step (to the nearest image that a pair joins to it) and its reach (the median
/// distance of its points) are asked. Both are smaller, or both larger, than those of the model's
/// images in the median by more than 32 times: a room is a fifth of a street's reach and its steps
/// a twentieth, so that no world that panoramas are taken of has both. Where some are smaller and
/// some larger, the fewer. Time linear in pairs and observations.
[[nodiscard]] std::vector<ImageSlot> ImagesOffScale(const MappingState& state);

/// Takes them out, and what hangs at the rest by them alone. Returns all of these, ascending.
std::vector<ImageSlot> DropOffScaleImages(MappingState& state);

}  // namespace orbweave
