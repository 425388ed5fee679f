// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "core/base/stage_context.h"
#include "core/features/extract_options.h"
#include "core/scene/features.h"

namespace orbweave {

/// Appends the features of the facade views (FacadeView) of a panorama, 8-bit BGR, to those of the
/// panorama itself: SIFT of each view, options.facade_features of it spread over the sphere, of the
/// largest scales first. Keypoints lie in the panorama; their scale is that of the solid angle they
/// cover there, their orientation that in the view. `ignored` as for UsefulPlaces. Where a view
/// ends within reach of a descriptor there are none. Panoramas wider than 4096 px are reduced to
/// that: what is finer shows walls that look at the camera, which the panorama's own features have.
/// Cancelled when asked to stop.
absl::Status AppendFacadeFeatures(const cv::Mat& panorama,
                                  const cv::Mat& ignored,
                                  const ExtractOptions& options,
                                  const StageContext& context,
                                  Features& features);

}  // namespace orbweave
