// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "core/base/stage_context.h"
#include "core/features/described_keypoints.h"
#include "core/features/extract_options.h"
#include "core/features/useful_places.h"

namespace orbweave {

/// The keypoints of a panorama (8-bit BGR) by StreamingSift, spread over the sphere: positions are
/// chosen first, only these get orientations and descriptors.
[[nodiscard]] absl::StatusOr<DescribedKeypoints> ExtractStreamingSift(const cv::Mat& panorama,
                                                                      const UsefulPlaces& places,
                                                                      const ExtractOptions& options,
                                                                      const StageContext& context);

}  // namespace orbweave
