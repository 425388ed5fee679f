// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// No third image confirms a point of two observations: a wrong match that happens to lie on its
/// epipolar plane looks the same. Removes such points when an error exceeds `max_error_px`, or when
/// both images have `enough` observations of longer tracks. Returns the number of points removed.
uint32_t DropTwoViewPoints(MappingState& state, double max_error_px, int enough);

}  // namespace orbweave
