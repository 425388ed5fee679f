// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/features.h"

namespace orbweave {

/// The features of the panorama itself (Features::NumPlain), the largest scales first; of equal
/// scales that of the lower index.
[[nodiscard]] std::vector<FeatureIndex> OrderByScale(const Features& features);

}  // namespace orbweave
