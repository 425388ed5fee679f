// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/features/sift/gaussian_taps.h"
#include "core/features/sift/sift_kernels.h"

namespace orbweave::internal {

/// Rows [begin, end).
struct RowRange {
  int begin = 0;
  int end = 0;
  friend bool operator==(const RowRange&, const RowRange&) = default;
};

/// Rows that a keypoint's refinement may look at above and below where it was found.
constexpr int kRefinementReach = 6;
/// A descriptor's samples reach 8.5 sqrt(2) steps of 15/16 standard deviations, 3.6 px at the end
/// of an octave, and a pixel of interpolation.
constexpr int kPatchRadius = 43;

/// The grid of an octave and the rows of it that are needed. All grids cover the whole sphere,
/// pixels' corners at whole numbers, so that seam and poles are at the borders of pixels.
struct OctavePlan {
  int octave = 0;  ///< pixels are about 2^octave pixels of the panorama wide
  int width = 0;
  int height = 0;
  double panorama_from_x = 1.0;  ///< factor of columns, corner convention
  double panorama_from_y = 1.0;
  RowRange detection{};                        ///< rows where extrema are looked for
  std::array<RowRange, kSiftLevels> levels{};  ///< rows that are computed
};

/// What is computed of a panorama.
struct ScaleSpacePlan {
  int width = 0;  ///< of the panorama
  int height = 0;
  bool doubled = false;
  double sigma_0_px = 1.6;  ///< of level 0, pixels of its octave
  RowRange base{};          ///< rows of the first octave's grid, before any blur
  GaussianTaps base_taps{};
  std::array<GaussianTaps, kSiftLevels - 1> taps{};  ///< from level l to l + 1
  std::vector<OctavePlan> octaves{};                 ///< finest first; none of a tiny panorama
};

/// Standard deviation of a level, pixels of its octave: sigma_0 x 2^(level / 3).
[[nodiscard]] double SigmaOfLevel(const ScaleSpacePlan& plan, double level);

/// Octaves for keypoints whose centres lie between two rows of the panorama (corner convention),
/// from the doubled panorama or the panorama itself, down to a height of 32 pixels. Scales begin at
/// 1.6 px, where extrema are found again most often (Lowe, IJCV 2004, section 3.3), or, without
/// doubling, half an octave lower: the doubled panorama's best features are mostly there. Rows that
/// no keypoint's blur, extremum or descriptor sees are left out, on every level.
[[nodiscard]] ScaleSpacePlan PlanScaleSpace(
    int width, int height, bool doubled, double first_y, double end_y);

}  // namespace orbweave::internal
