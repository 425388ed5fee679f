// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// How far the verified pairs among the registered images bear a model out. Growing image by image
/// looks at such evidence at every step; a model that was begun with all images at once has to
/// show it in the end.
struct PairCheck {
  /// Share of the matches that belong to pairs which agree in rotation and direction: half of a
  /// pair's matches or more lie within options.max_error_px of the model's epipolar planes and in
  /// front of both images.
  double agreeing_share = 0.0;
  /// Share of all matches that ended in a common point.
  double explained_share = 0.0;
  /// Share of the images in the largest set that is joined by pairs of which a quarter of the
  /// matches ended in a common point, as registration asks for.
  double joined_share = 0.0;
  /// Whether GNSS says where images are that no common points join: the state is in east, north and
  /// up, and nine tenths of its images lie where their positions are (AgreementWithPositions).
  bool is_joined_by_positions = false;
  /// The largest of the images' median errors over the median of those medians: 1 where all images
  /// are alike; much more where the model is of two minds.
  double worst_image_ratio = 0.0;
};

/// Pure rotations join images but take no part in the shares of matches.
[[nodiscard]] PairCheck CheckAgainstPairs(const MappingState& state, const MappingOptions& options);

/// That its images are not joined, in words; empty where they are.
[[nodiscard]] std::string TearOf(const PairCheck& check);

/// The first thing that a sound model does not show, in words; empty for a sound one.
[[nodiscard]] std::string FaultOf(const PairCheck& check);

}  // namespace orbweave
