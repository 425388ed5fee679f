// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/dense_records.h"

namespace orbweave {

/// Whom a panorama is fused with.
struct Neighbourhood {
  /// Whether it gives points to the cloud. Where panoramas stand close, as frames of a video do,
  /// some do; the others have checked their maps.
  bool gives_points = true;
  /// What is farther from the camera than this is left to other panoramas.
  double reach_m = 0.0;
  std::vector<ImageId> neighbours{};  ///< ascending
};

/// For each panorama of the plan those that give points and whose maps may show the same surface
/// within both reaches, and no fewer: |c - c'| <= r + r'. Mutual. The reach r is 6 times the
/// distance to the first source, whose rays meet those of the typical surface at 12 degrees or so,
/// which is then at 5 of these; less where more than `max_neighbours` others would come within
/// 2 r. A panorama nearer than r / 6.5 to one before it that gives points gives none.
[[nodiscard]] std::vector<Neighbourhood> MutualNeighbours(const DensePlan& plan,
                                                          size_t max_neighbours);

}  // namespace orbweave
