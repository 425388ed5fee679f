// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Closes loops that came round to where they began a little beside it. What a model drifts on its
/// way round may be more than any point is allowed to be off, so that the pair which would close
/// the loop has no point, and no adjustment brings its images together: a street round a block came
/// back 9 degrees off the direction of a pair of 148 matches, right ones all, and stayed 6 off.
///
/// A general pair of 2 min_inliers matches has drifted apart when hardly a match ended in a common
/// point (a fifth; Wu, Towards Linear-Time Incremental Structure from Motion, 3DV 2013, section 4),
/// three fifths of its own matches (OwnMatches) do not lie in the epipolar planes of the model's
/// pose, and yet lie there and in front of both images to five degrees: places that look alike are
/// far further off, or lie in the planes. Those of images beside each other (FindTornPairs) are not
/// places that look alike; they may be 30 degrees off. The matches become points at that tolerance,
/// everything is adjusted under a loss that is as wide, then as ever (AdjustGrowingModel). All
/// stays as it was unless more matches agree with the result (CountMatchesInPlanes) and GNSS does
/// not like it less (IsLikedByGnss).
///
/// Whether anything was closed. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> CloseDrift(MappingState& state,
                                              const MappingOptions& options,
                                              const StageContext& context);

}  // namespace orbweave
