// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/graph/motion_edge.h"

namespace orbweave {

/// Images joined by their strongest edges, without a circle (a spanning forest of most weight,
/// Kruskal 1956): what turns between images some edges apart is the sum of the turns on the way,
/// and the strongest edges are those of neighbours, which hardly ever turn wrongly.
class TurnForest {
 public:
  TurnForest(uint32_t num_images, const std::vector<MotionEdge>& edges);

  struct Link {
    uint32_t image = 0;
    double turn_rad = 0.0;  ///< heading of the image asked for less heading of this one
  };

  /// The image itself and those up to `reach` edges away, the nearest first; 64 at most. Upright
  /// cameras turn by a degree less or more than an edge says: three degrees at eight edges.
  [[nodiscard]] std::vector<Link> Around(uint32_t image, size_t reach) const;

 private:
  std::vector<std::vector<Link>> links_;
};

}  // namespace orbweave
