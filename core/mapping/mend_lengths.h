// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/mapping_options.h"
#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Moves images at faults of lengths (FindLengthFaults: they themselves, or both sides of a tear)
/// to where the rays of those around them put them (CentreByLengths), unless GNSS speaks against it
/// (StepWitness), makes their points anew and adjusts around them, one after the other in order of
/// images, as long as more rays agree with the model after each. A few rounds of it, as a piece of
/// several images is moved one by one. All of it stays as it was unless more speaks for the result
/// (SpeaksMoreFor). Returns how many images were moved. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<int> MendLengths(MappingState& state,
                                              const MappingOptions& options,
                                              const StageContext& context);

}  // namespace orbweave
