// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "core/dense/depth_map.h"

namespace orbweave {

/// Share of the sphere that has a depth.
inline double CoverageOf(const DepthMap& map) {
  if (map.size() == 0) return 0.0;
  const auto known = std::ranges::count_if(map.range_m, [](float range) { return range > 0.0F; });
  return static_cast<double>(known) / static_cast<double>(map.size());
}

}  // namespace orbweave
