// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/block_matrix.h"
#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// One Gauss-Newton step of an image's pose against the points that one cluster's panoramas see,
/// points fixed; (w, C) in world axes.
struct SidePlacement {
  ImageId image{};
  uint32_t cluster = 0;
  Block6 hessian = Block6::Zero();
  Vector6 gradient = Vector6::Zero();
  uint32_t num_points = 0;
};

/// This subproblem's share of the placements of all images that panoramas of two clusters may
/// place, sorted by (image, cluster). A point is a cluster's when two of its panoramas see it
/// besides the image that is placed.
[[nodiscard]] std::vector<SidePlacement> PlaceBySides(const Subproblem& subproblem);

}  // namespace orbweave
