// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/graph/motion_edge.h"
#include "core/graph/turn_forest.h"

namespace orbweave {

struct HeadingOptions {
  size_t reach = 8;  ///< steps of the forest (TurnForest) from which an image is told its heading
  double agree_rad = std::numbers::pi / 6.0;
};

/// How cameras are headed, by the azimuths of steps between images, by GNSS or along the way of a
/// drive, and in their cameras.
///
/// An edge of two images 2.5 standard deviations apart says how both are headed: azimuth of the
/// step less azimuth of the step in the camera. What edges around say (TurnForest) goes over by
/// the turns between. The heading is the one from which most of it, by weight, is `agree_rad` or
/// less off: more than half of all, and three edges at least; in the mean over these, by their
/// variances. Edges between neighbours of the sequence decide, as few of them are of places that
/// only look alike; where these do not tell, all do. Edges of images that are not `is_trusted` say
/// nothing.
///
/// Time linear in images and edges, but for sorting.
[[nodiscard]] Headings FindHeadings(const std::vector<MotionEdge>& edges,
                                    const TurnForest& forest,
                                    const std::vector<uint8_t>& is_trusted,
                                    const HeadingOptions& options = {});

}  // namespace orbweave
