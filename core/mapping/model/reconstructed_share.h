// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Share of a pair's matches that ended in a common point of the model: 0 ... 1.
[[nodiscard]] double ReconstructedShare(const MappingState& state, const LinkedPair& pair);

/// The number of those matches.
[[nodiscard]] size_t CountReconstructed(const MappingState& state, const LinkedPair& pair);

}  // namespace orbweave
