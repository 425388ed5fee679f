// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/bundle/adjust_bundle.h"
#include "core/merging/georeference_reconstruction.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// The poses of a world and what GNSS says of them: a pose per image that is not loose, in id
/// order.
struct GlobalProblem {
  BundleProblem bundle{};
  std::vector<ImageId> image_of_pose{};
};

[[nodiscard]] GlobalProblem MakeGlobalProblem(const Reconstruction& reconstruction);

/// GNSS as position priors for a model in east-north-up metres, no more trusted than the scatter
/// found by georeferencing; a bias per drive when there are two drives or more (the bias of one
/// drive cannot be told from the frame). Gravity as direction priors that together weigh as one
/// measurement of kGravitySigma_rad, since all panoramas share the mount: they keep a straight
/// street, whose GNSS says nothing of it, from rolling.
void AddGnss(const Reconstruction& reconstruction,
             const ImageManifest& manifest,
             const Georeference& georeference,
             double bias_sigma_m,
             GlobalProblem& problem);

}  // namespace orbweave
