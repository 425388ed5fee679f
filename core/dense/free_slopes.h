// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/dense/match_patches.h"

namespace orbweave {

/// Sum of e e^T over the sources, e the direction in which a pixel of the reference moves in a
/// source as its range changes (columns, rows), with a weight; the trace is 1.
struct ParallaxDirections {
  float columns = 0.0F;
  float both = 0.0F;
  float rows = 0.0F;
};

/// Where in each lane's patch the texture lies that tells its range: weighted moments of q =
/// max(0, g^T D g - noise), g the differences of levels two pixels apart, D the directions, about
/// the patch's middle in pixels. `texture` is the sum itself; the others are divided by it, 0
/// without texture.
struct TextureMoments {
  LaneFloats texture{};
  LaneFloats column{}, row{};
  LaneFloats column_column{}, column_row{}, row_row{};
};

/// `middle`, `stride` and `patches` as PreparePatches has them; `noise_variance` that of a level.
[[nodiscard]] TextureMoments MomentsOfTexture(const uint8_t* middle,
                                              int stride,
                                              const ReferencePatches& patches,
                                              const ParallaxDirections& directions,
                                              float noise_variance);

/// Variance of the parallax at the patch's middle when the slopes of its plane are not known
/// either, but within `slope` (one sigma, pixels of parallax a pixel), from `variance_px2`, that of
/// a patch whose slopes are known. With m the middle of the texture and S its second moments about
/// m, less one square pixel that every blurred edge has,
///
///   variance' = variance (1 + m^T (S + I variance / slope^2)^-1 m) :
///
/// a patch with texture on one side only, as beside a line on a bare road, knows the range of that
/// side, and of its middle no more than the slope lets it know.
[[nodiscard]] float FreeSlopeVariance(const TextureMoments& moments,
                                      size_t lane,
                                      float variance_px2,
                                      float slope);

}  // namespace orbweave
