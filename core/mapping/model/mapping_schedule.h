// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/bundle/bundle_options.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/triangulate_tracks.h"

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
  /// The next image by the score of its visible points alone; else also by their number.
  bool ranks_by_score = false;
  /// More than this many images registered since the last adjustment: these are adjusted with their
  /// points, all else held. 0: each image with its covisible window, at once.
  int new_images_before_local = 0;
  /// Limits of errors follow the exactness of the model, points of two observations go where there
  /// are better ones.
  bool tightens = true;
  /// Observations count alike in pixels, whatever the scale of their features.
  bool weighs_pixels_alike = false;
};

/// The paper asks for 30 visible points, ranks by score alone, adjusts locally once N > 3 images
/// are new and knows neither relaxed registration nor proposals nor any limit that changes (section
/// 4).
[[nodiscard]] inline MappingSchedule ScheduleOf(const MappingOptions& options) {
  if (options.preset == MappingPreset::kPaper) {
    return {.min_visible = 30,
            .relaxes_registration = false,
            .seeds_by_image = true,
            .ranks_by_score = true,
            .new_images_before_local = 3,
            .tightens = false,
            .weighs_pixels_alike = true};
  }
  return {.min_visible = options.min_inliers,
          .relaxes_registration = true,
          .seeds_by_image = false,
          .start = options.start};
}

/// `how` as the preset adjusts: the paper's cost (11) is of pixels in the image, without a loss.
[[nodiscard]] inline BundleOptions AsPresetAdjusts(const MappingOptions& options,
                                                   BundleOptions how) {
  if (options.preset == MappingPreset::kPaper) {
    how.loss = BundleLoss::kLeastSquares;
    how.residual = BundleResidual::kErpPx;
  }
  return how;
}

[[nodiscard]] inline TrackLimits LimitsOf(const MappingOptions& options) {
  return {.max_error_px = options.max_error_px, .min_angle_deg = options.min_angle_deg};
}

}  // namespace orbweave
