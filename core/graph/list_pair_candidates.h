// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"

namespace orbweave {

/// How much further the reserve looks: of windows, radii and counts.
inline constexpr int kReserveFactor = 2;

/// SelectImagePairs in three steps. `first` and `second` together are the pairs that it selects
/// with `similar` cut to `num_similar` per image, look-alikes of images without a position alone;
/// of these, `first` has for each image the pairs.first_neighbours nearest of each kind. `reserve`
/// is what kReserveFactor times the window, radius and neighbours add, with all look-alikes. Small
/// jobs, and all where first_neighbours is 0, have `first` alone.
[[nodiscard]] PairCandidates ListPairCandidates(const ImageManifest& manifest,
                                                const std::vector<std::vector<ImageId>>& similar,
                                                int num_similar,
                                                const PairOptions& options);

}  // namespace orbweave
