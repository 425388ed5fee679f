// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/scene/two_view_geometry.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What the view graph keeps of a pair.
[[nodiscard]] inline ViewEdge ViewEdgeOf(const TwoViewGeometry& geometry) {
  return {.pair = geometry.pair,
          .kind = geometry.kind,
          .b_from_a = geometry.b_from_a,
          .num_inliers = static_cast<uint32_t>(geometry.inliers.size()),
          .median_angle_rad = geometry.median_angle_rad,
          .spread = geometry.spread,
          .rung = geometry.rung};
}

}  // namespace orbweave
