// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/mapping_options.h"
#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Where rays contradict lengths of the model (FindLengthFaults): moves images and pieces of the
/// street (ListCandidateMoves), each time as most rays agree with (CountAgreeingRays), as long as
/// more do than before and GNSS does not speak against it (StepWitness). Then points are made anew
/// that images see which were moved by different amounts, and everything is adjusted. All of it
/// stays as it was unless more speaks for the result (SpeaksMoreFor).
///
/// Whether anything was moved. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> MendLengths(MappingState& state,
                                               const MappingOptions& options,
                                               const StageContext& context);

}  // namespace orbweave
