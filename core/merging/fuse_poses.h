// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// One submodel's estimate of an image's pose, in the common world.
struct PoseEstimate {
  Rigid3 cam_from_world{};
  bool loose = false;
  double weight = 1.0;  ///< number of observations, > 0
};

using PoseEstimates = std::map<ImageId, std::vector<PoseEstimate>>;

/// One pose per image: the weighted mean of rotation and centre over the estimates that are not
/// loose (over all where all are, and the image stays loose), with Huber weights about it. The
/// Huber scale is three times the median disagreement in the whole world: what the seams usually
/// leave is averaged, an estimate far off counts little against a heavier one.
[[nodiscard]] std::map<ImageId, RegisteredImage> FusePoses(const PoseEstimates& estimates);

}  // namespace orbweave
