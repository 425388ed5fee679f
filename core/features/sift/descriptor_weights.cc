// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/descriptor_weights.h"

#include <algorithm>
#include <cmath>

namespace orbweave::internal {
namespace {

DescriptorWeights ComputeWeights() {
  DescriptorWeights weights;
  for (size_t i = 0; i < kDescriptorGrid; ++i) {
    const double cells =
        (static_cast<double>(i) - 7.5) * kDescriptorSpanCells / kDescriptorGrid;  // from the middle
    const double gauss = std::exp(-cells * cells / 8.0);
    for (size_t c = 0; c < 4; ++c) {
      const double apart = std::abs(cells - (static_cast<double>(c) - 1.5));
      weights.of_cell[c][i] = static_cast<float>(gauss * std::max(0.0, 1.0 - apart));
    }
  }
  return weights;
}

}  // namespace

const DescriptorWeights& WeightsOfDescriptor() {
  static const DescriptorWeights kWeights = ComputeWeights();
  return kWeights;
}

}  // namespace orbweave::internal
