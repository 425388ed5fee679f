// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The pose of an image that was just registered, from the scene points that agree with it
/// (SupportOf), which are held: what follows P3P in the paper's section 3.4. Without any it stays.
[[nodiscard]] absl::Status AdjustPose(MappingState& state,
                                      ImageSlot image,
                                      const MappingOptions& options,
                                      const StageContext& context);

/// The paper's local adjustment (section 4): the poses of `images`, registered lately, and the
/// points that they see, all other poses held. Then completes, merges and filters these points, as
/// AdjustLocally does.
[[nodiscard]] absl::Status AdjustNewImages(MappingState& state,
                                           std::span<const ImageSlot> images,
                                           const MappingOptions& options,
                                           const StageContext& context);

}  // namespace orbweave
