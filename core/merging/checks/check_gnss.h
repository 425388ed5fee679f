// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/merging/georeference/georeference.h"
#include "core/merging/georeference/global_problem.h"
#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// What the adjusted model and GNSS say of each other, beside what georeferencing found
/// (Georeference::checks, which come first):
///   gnss_correlation  by how much errors that neighbours share inflate the variance of the frame
///   mount_tilt        where a street runs so straight that neither GNSS nor turns tell how far the
///                     cameras lean to the side, the model stands as if they were upright: doubtful
///                     where ground and walls (MeasureSceneLean of `points_about`) lean
/// `problem` holds the poses and the priors of a world that is georeferenced; else only what
/// georeferencing found is said.
[[nodiscard]] std::vector<CrossCheck> CheckGnss(const GlobalProblem& problem,
                                                const std::vector<Eigen::Vector3d>& biases_m,
                                                const Georeference& georeference,
                                                const ImageManifest& manifest,
                                                std::span<const Eigen::Vector3d> points_about);

/// What not knowing the errors of drives exactly (Georeference::drive_errors) adds to the
/// uncertainty of the images' centres; nothing where there are none.
void WidenByDriveErrors(const Georeference& georeference,
                        const ImageManifest& manifest,
                        Reconstruction& model);

}  // namespace orbweave
