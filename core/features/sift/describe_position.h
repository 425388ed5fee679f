// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/features/sift/row_ring.h"
#include "core/features/sift/sift_kernels.h"
#include "core/features/sift/sift_position.h"
#include "core/scene/features.h"

namespace orbweave::internal {

/// A position with one of the dominant directions of its surroundings.
struct DescribedPosition {
  uint32_t position = 0;         ///< number of the position
  float orientation_rad = 0.0F;  ///< in [0, 2 pi), from columns to rows
  std::array<uint8_t, kDescriptorSize> descriptor{};
};

/// Describes positions of one octave. Orientations are the peaks of a histogram of gradients at
/// least 0.8 times as high as the highest (Lowe, IJCV 2004, section 5). A descriptor is the
/// histogram of 4 x 4 cells and 8 directions of gradients that are sampled on a grid of 16 x 16 in
/// the keypoint's frame, cells 3 standard deviations wide, cut at 0.2 of its length (section 6.1),
/// as RootSIFT: the square root of the L1-normalised histogram, times 512, 8 bits
/// (Arandjelovic, Zisserman, CVPR 2012).
class PositionDescriber {
 public:
  explicit PositionDescriber(const SiftKernels& kernels);

  /// Appends the position `number` once for each of its orientations. `rows` are of its level,
  /// `sigma_px` is its scale in pixels of these.
  void Describe(const SiftPosition& position,
                float sigma_px,
                uint32_t number,
                const RowRing& rows,
                std::vector<DescribedPosition>& described);

 private:
  const SiftKernels& kernels_;
  std::vector<float> pixels_{};
};

}  // namespace orbweave::internal
