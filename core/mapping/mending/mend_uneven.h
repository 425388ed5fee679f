// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Where images stand off the even steps of their drive (FindUnevenRuns), or a step leads hardly
/// anywhere, or back (FindVanishedWays): moves the image that does so the most, with those beside
/// it that stand off alike, along the way to about its even place, where most rays agree
/// (CountAgreeingRays), or all that lies behind the step (LinePieces) to where it is about as long
/// as those around; makes their points anew and adjusts everything. Kept is what GNSS likes better
/// (IsLikedByGnss), or does not like less and more speaks for it (RaysAndStepsSpeakMoreFor): rays
/// that took one window for the next like the wrong place better by themselves, and never say that
/// there is another one.
///
/// Whether anything was moved. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> MendUneven(MappingState& state,
                                              const MappingOptions& options,
                                              const StageContext& context);

}  // namespace orbweave
