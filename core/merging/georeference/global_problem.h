// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/bundle/bundle_problem.h"
#include "core/merging/georeference/georeference.h"
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

/// The manifest with what georeferencing found wrong of drives taken off the positions of the
/// images of `reconstruction`, which is in the frame that was georeferenced.
[[nodiscard]] ImageManifest WithoutDriveErrors(const Reconstruction& reconstruction,
                                               ImageManifest manifest,
                                               const Georeference& georeference);

/// GNSS as position priors for a model in east-north-up metres, without what georeferencing found
/// wrong of its drives, and no more trusted than the scatter it found; a bias per drive when there
/// are two drives or more (the bias of one drive cannot be told from the frame), about free for one
/// in another datum. Gravity (EstimateGravity) as direction priors that together weigh as one
/// measurement of its sigma, since all panoramas share the mount: they keep a straight street,
/// whose GNSS says nothing of it, from rolling, and own that they may be wrong. `gravity_weight`:
/// by how much gravity counts more than its sigma says, as positions count as independent
/// (Georeference::gnss_inflation).
void AddGnss(const Reconstruction& reconstruction,
             const ImageManifest& manifest,
             const Georeference& georeference,
             double bias_sigma_m,
             double gravity_weight,
             GlobalProblem& problem);

}  // namespace orbweave
