// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// When a ray and a point are taken to belong together.
struct TrackLimits {
  double max_error_px = 4.0;   ///< angle between bearing and point, pixels at the equator (8)
  double min_angle_deg = 1.5;  ///< triangulation angle of a new point
};

/// Adds the free node to that point among its neighbours' points which it agrees with best.
/// False: there is none within limits.max_error_px, or all of them are seen by the image already.
bool ContinueTrack(MappingState& state, Node node, const TrackLimits& limits);

/// A new point from the free node and those of `others` (free, in registered images) that most rays
/// agree on, one per image. kNoPoint: no point holds `node` and another one under the limits.
PointIndex CreatePoint(MappingState& state,
                       Node node,
                       std::span<const Node> others,
                       const TrackLimits& limits);

/// Continues or creates points from every free feature of a registered image. Returns the number
/// of observations added.
uint32_t TriangulateImage(MappingState& state, ImageSlot image, const TrackLimits& limits);

}  // namespace orbweave
