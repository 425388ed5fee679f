// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/features.h"

namespace orbweave {

/// What a detector gives: the keypoints that are kept, by row, then column.
struct DescribedKeypoints {
  std::vector<Keypoint> keypoints{};
  std::vector<float> sigma_px{};       ///< standard deviation, pixels at the equator
  std::vector<uint8_t> descriptors{};  ///< keypoints.size() x kDescriptorSize, RootSIFT x 512
};

}  // namespace orbweave
