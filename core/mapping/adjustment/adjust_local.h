// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Images that share most points with `image`, itself first: `size` images at most.
[[nodiscard]] std::vector<ImageSlot> CovisibleWindow(const MappingState& state,
                                                     ImageSlot image,
                                                     int size);

/// After `image` was registered and triangulated: adjusts the poses of its covisible window and the
/// points that the image or two others of the window see, other images held, under a Cauchy loss;
/// then completes, merges and filters these points. Cost: bounded by the window, not by the model.
[[nodiscard]] absl::Status AdjustLocally(MappingState& state,
                                         ImageSlot image,
                                         const MappingOptions& options,
                                         const StageContext& context);

}  // namespace orbweave
