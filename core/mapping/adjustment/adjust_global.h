// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Re-triangulates, completes and merges tracks, adjusts everything under a Cauchy loss and
/// filters; again while much is filtered, a few rounds at most. For the model while it grows.
[[nodiscard]] absl::Status AdjustGrowingModel(MappingState& state,
                                              const MappingOptions& options,
                                              const StageContext& context);

/// Adjusts everything once, under a Cauchy loss that is made for points `max_error_px` off.
[[nodiscard]] absl::Status AdjustWidely(MappingState& state,
                                        const MappingOptions& options,
                                        double max_error_px,
                                        const StageContext& context);

/// The same until hardly anything changes, then least squares over what is left: the final model.
[[nodiscard]] absl::Status AdjustFinalModel(MappingState& state,
                                            const MappingOptions& options,
                                            const StageContext& context);

/// The final model once more without walls that are not there (DropGhostPoints), where it has any.
/// For models whose shape is settled: points that come into the place of others may be taken for
/// what holds two streets together.
[[nodiscard]] absl::Status AdjustWithoutGhosts(MappingState& state,
                                               const MappingOptions& options,
                                               const StageContext& context);

}  // namespace orbweave
