// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Registered images that may stand elsewhere, and where.
using CandidateMove = std::map<ImageSlot, Rigid3>;  ///< cam_from_world

/// Poses alone are moved; points stay where they are.
void PutAt(MappingState& state, const CandidateMove& move);
/// Where the images of a move stand, to put them back.
[[nodiscard]] CandidateMove PosesNow(const MappingState& state, const CandidateMove& of);

/// These images shifted alike, turned as they are.
[[nodiscard]] CandidateMove Shifted(const MappingState& state,
                                    const std::vector<ImageSlot>& images,
                                    const Eigen::Vector3d& by);

/// After images of `moved` were put elsewhere than they stand in `before`, which has the same ones:
/// points go along with the images that see them, and those seen by images that were moved
/// differently are made anew, with three times the allowed error, as centres told by rays are right
/// to some hundredths of a step.
void RemakePoints(MappingState& moved, const MappingState& before, const MappingOptions& options);

}  // namespace orbweave
