// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Unites points that no match joins although they are one: each point is projected into the
/// registered images that are matched with one of its own but do not see it; where a point seen
/// there lies within `max_error_px`, and one position explains all observations of both within
/// that, the two become one (MergePair). Joins tracks that matching tore apart. Returns the number
/// of points that went up in others.
uint32_t MergeCoincidentPoints(MappingState& state, double max_error_px);

}  // namespace orbweave
