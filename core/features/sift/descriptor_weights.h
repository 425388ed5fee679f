// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/features/sift/sift_kernels.h"

namespace orbweave::internal {

/// Cells of 3 standard deviations that the 16 samples of a descriptor's row span: 4, and half a
/// cell of interpolation on both sides.
constexpr float kDescriptorSpanCells = 5.0F;

/// What the samples of a descriptor count in the four cells of a row (or column): bilinear, times a
/// Gaussian of two cells. A sample weighs of_cell[cy][row] x of_cell[cx][column].
struct DescriptorWeights {
  alignas(64) std::array<std::array<float, kDescriptorGrid>, 4> of_cell{};
};

[[nodiscard]] const DescriptorWeights& WeightsOfDescriptor();

}  // namespace orbweave::internal
