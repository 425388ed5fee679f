// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Where rays and matches contradict the model (FindLengthFaults): turns and moves pieces of the
/// street and single images, first as most matches agree with (ListTurns, CountMatchesInPlanes),
/// then as most rays do (ListShifts, CountAgreeingRays), move by move, as long as more agree than
/// before and GNSS does not speak against it (StepWitness). Then points are made anew that images
/// see which were moved differently, and everything is adjusted. All of it stays as it was unless
/// more speaks for the result (SpeaksMoreFor).
///
/// Whether anything was moved. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> MendLengths(MappingState& state,
                                               const MappingOptions& options,
                                               const StageContext& context);

}  // namespace orbweave
