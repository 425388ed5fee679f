// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/depth_map.h"

namespace orbweave {

/// Takes away the ranges of surfaces of fewer than `min_pixels` pixels of a face; neighbours are
/// one surface where their ranges differ by less than 5 %.
void RemoveSpeckles(int min_pixels, DepthMap& map);

}  // namespace orbweave
