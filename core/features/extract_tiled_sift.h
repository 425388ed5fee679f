// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "core/base/stage_context.h"
#include "core/features/described_keypoints.h"
#include "core/features/extract_options.h"
#include "core/features/useful_places.h"

namespace orbweave {

/// The keypoints of a panorama (8-bit BGR) by OpenCV's SIFT, in overlapping tiles
/// (DetectSift), spread over the sphere. The oracle of ExtractStreamingSift.
[[nodiscard]] absl::StatusOr<DescribedKeypoints> ExtractTiledSift(const cv::Mat& panorama,
                                                                  const UsefulPlaces& places,
                                                                  const ExtractOptions& options,
                                                                  const StageContext& context);

}  // namespace orbweave
