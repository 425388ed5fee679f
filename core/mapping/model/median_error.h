// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// How exact the model is: median error of its observations, in pixels at the equator. Of points
/// with three observations or more, as two are fitted too easily to tell; of all points where
/// there are not a hundred such observations. 0 without any.
[[nodiscard]] double MedianErrorPx(const MappingState& state);

}  // namespace orbweave
