// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// What a model is worth beside others of the same images: how many it holds that GNSS does not
/// contradict by their steps (StepWitness), times the share that lie on their positions
/// (AgreementWithPositions; 1 where these tell nothing). A model that holds one image more, and has
/// lost the scale of a street for it, is worth less. Without positions: how many it holds.
[[nodiscard]] double BorneOutImages(const MappingState& state);

}  // namespace orbweave
