// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/reconstruct_cluster.h"
#include "core/mapping/triangulate_tracks.h"

namespace orbweave {

/// What a preset settles beside the options.
struct MappingSchedule {
  /// Scene points an image must see before it is tried.
  int min_visible = 20;
  /// Images that fail are tried once more with fewer points, also from poses that pairs propose.
  bool relaxes_registration = true;
  /// Seeds by matches of the first image, then of the pair, as in the paper; else by pair alone.
  bool seeds_by_image = false;
  /// The paper begins with a seed pair.
  MappingStart start = MappingStart::kIncremental;
};

/// The paper asks for 30 visible points and knows neither relaxed registration nor proposals.
[[nodiscard]] inline MappingSchedule ScheduleOf(const MappingOptions& options) {
  if (options.preset == MappingPreset::kPaper) {
    return {.min_visible = 30, .relaxes_registration = false, .seeds_by_image = true};
  }
  return {.min_visible = options.min_inliers,
          .relaxes_registration = true,
          .seeds_by_image = false,
          .start = options.start};
}

[[nodiscard]] inline TrackLimits LimitsOf(const MappingOptions& options) {
  return {.max_error_px = options.max_error_px, .min_angle_deg = options.min_angle_deg};
}

}  // namespace orbweave
