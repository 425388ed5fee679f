// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/dense_records.h"

namespace orbweave {

/// Whom a panorama is fused with.
struct Neighbourhood {
  /// What is farther from the camera than this is left to other panoramas.
  double reach_m = 0.0;
  std::vector<ImageId> neighbours{};  ///< ascending
};

/// For each panorama of the plan those whose maps may show the same surface within both reaches,
/// and no fewer: |c - c'| <= r + r'. Mutual. The reach r is 1.5 times the distance to the farthest
/// source, or less where more than `max_neighbours` others would come within 2 r.
[[nodiscard]] std::vector<Neighbourhood> MutualNeighbours(const DensePlan& plan,
                                                          size_t max_neighbours);

}  // namespace orbweave
