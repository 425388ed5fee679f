// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/graph/motion_edge.h"
#include "core/graph/turn_forest.h"

namespace orbweave {

/// How cameras are headed, by what steps between images are by GNSS and in their cameras.
///
/// An edge of two images 2.5 standard deviations apart says how both are headed: azimuth of the
/// step by GNSS less azimuth of the step in the camera. What edges around say (TurnForest) goes
/// over by the turns between. The heading is the one from which most of it, by weight, is 30
/// degrees or less off: more than half of all, and three edges at least; in the mean over these, by
/// their variances. Edges between neighbours of the sequence decide, as few of them are of places
/// that only look alike; where these do not tell, all do. Edges of images that are not `is_trusted`
/// say nothing.
///
/// Time linear in images and edges, but for sorting.
[[nodiscard]] Headings HeadingsByGnss(const std::vector<MotionEdge>& edges,
                                      const TurnForest& forest,
                                      const std::vector<uint8_t>& is_trusted);

}  // namespace orbweave
