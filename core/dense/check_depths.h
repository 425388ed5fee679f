// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/dense/dense_options.h"
#include "core/dense/depth_map.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// The map of another panorama, as EstimateDepths left it; its `views` are not read.
struct NeighbourMap {
  const DepthMap* map = nullptr;
  Rigid3 neighbour_from_reference{};
};

/// Keeps of `own` what its neighbours found, too. A neighbour agrees with a point when the surface
/// that it has there (its pixel's plane, cut by the point's ray) is within three sigmas of both, or
/// 1 % of the range, and seen from here less than a pixel beside it. It sees through a point when
/// its surface lies behind it by more than that. A point stays with `min_agreeing` agreeing
/// neighbours (one more where no two rays meet at 4 degrees or more, at most as many as there are)
/// unless as many see through it, or they are less than `min_agreeing_share` of those asked, which
/// have a depth there, look from less than twice the distance, and see nothing stand before it by a
/// fifth of that: a point that two maps share and most deny is the errors of two. Surfaces of fewer
/// than `min_speckle_px` connected pixels go. Ranges become the mean of own and agreeing ones,
/// weighted by w = 1 / sigma^2. Of n agreeing neighbours, with c = kSharedVariance,
///
///   sigma^2 = k^2 (n + 1) / (sum w) (c + (1 - c) / (n + 1)) + bias^2,
///   k^2 = (4 + sum w (range - mean)^2 / (1 - c)) / (4 + n) :
///
/// the mean variance, less what a mean of ranges with common errors gains, and more or less as they
/// scatter more or less than they claim; `bias` is what 0.05 pixels of the largest parallax make.
/// An empty map stays as it is; maps of another size count as absent.
[[nodiscard]] DepthMap CheckDepths(DepthMap own,
                                   const std::vector<NeighbourMap>& neighbours,
                                   const DenseOptions& options);

}  // namespace orbweave
