// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/positioning/fit_plan.h"

namespace orbweave {

/// A registered image with a position, both seen from above.
struct PlacedImage {
  ImageSlot image = 0;
  PlanStation plan{};
};

/// Those of a model, in the order of places.
struct PlacedImages {
  Eigen::Quaterniond level_from_world = Eigen::Quaterniond::Identity();
  std::vector<PlacedImage> images{};  ///< none: positions tell nothing
};

/// What is up, cameras say (UprightFromWorld), or all positions where these do not agree. Fewer
/// than ten positions tell nothing.
[[nodiscard]] PlacedImages FindPlacedImages(const MappingState& state,
                                            const RegisteredSequence& places);

}  // namespace orbweave
