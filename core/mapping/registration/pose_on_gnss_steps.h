// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/scene_correspondences.h"
#include "core/mapping/registration/step_witness.h"

namespace orbweave {

/// The pose that GNSS puts in the place of `found`, if it does. Where whole houses repeat an image
/// may agree with hundreds of points a house too far along; the few points of all other places
/// agree with where it is, and so does the length of its step by GNSS, which alone would prove
/// little: one position in twenty is wrong.
///
/// So where GNSS contradicts `found` (StepWitness), the poses that pairs propose (PosesOfPairs) and
/// it supports are tried. The one with which points in most places of the image agree is refined
/// with these, and taken when it lies nearer by a sigma or more and the places speak for it too: a
/// place, a cell of SphereSpread, votes for the pose with which more of its points agree, and of
/// those that vote a third, four at least, vote for this one. A wrong position makes no place vote
/// for where it leads.
[[nodiscard]] std::optional<Rigid3> PoseOnGnssSteps(const MappingState& state,
                                                    ImageSlot image,
                                                    const StepWitness& gnss,
                                                    const Rigid3& found,
                                                    const SceneCorrespondences& correspondences,
                                                    double max_error_rad);

}  // namespace orbweave
