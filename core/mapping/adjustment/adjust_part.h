// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/base/stage_context.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_report.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Adjusts the poses of `images` and the positions of `points` to all observations of those points;
/// other images that see them are held. Where the state is in east, north and up, its images are
/// held to their GNSS positions too (PositionPrior). Writes the result back. `images` and `points`:
/// registered and existing, without repetition. Cancelled when asked to stop; the state is then
/// unchanged.
[[nodiscard]] absl::StatusOr<BundleReport> AdjustPart(MappingState& state,
                                                      std::span<const ImageSlot> images,
                                                      std::span<const PointIndex> points,
                                                      const BundleOptions& options,
                                                      const StageContext& context);

/// Standard deviation that an observation is given, radians: that of its keypoint, though never
/// below a tenth of a pixel.
[[nodiscard]] double NodeSigma(const MappingState& state, Node node);

}  // namespace orbweave
