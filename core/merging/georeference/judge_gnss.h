// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/merging/georeference/global_problem.h"
#include "core/partitioned_ba/global_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// What the adjusted model says of each GNSS position: an outlier lies further off than 99 % of the
/// positions with the priors' sigmas would (whitened distance above 3.37, bias taken off).
/// Positions of images that the model does not hold by itself - they are none of `images`, or loose
/// - say nothing of it and are not counted.
[[nodiscard]] GnssReport JudgeGnss(const GlobalProblem& problem,
                                   const std::vector<Eigen::Vector3d>& biases_m,
                                   const ImageManifest& manifest,
                                   const std::map<ImageId, RegisteredImage>& images);

}  // namespace orbweave
