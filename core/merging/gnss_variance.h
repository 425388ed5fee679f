// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/merging/correlated_noise.h"
#include "core/merging/global_problem.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// How far GNSS is to be believed about a whole adjusted model.
struct GnssVariance {
  /// Per world axis, x and y equal: by what claimed variances are to be multiplied
  /// (PositionVarianceFactors), times the inflation below.
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  CorrelatedNoise horizontal{};  ///< lengths in metres along the sequence
  CorrelatedNoise vertical{};
};

/// Errors of positions in a row are alike: satellites and houses stay the same for a hundred
/// metres. A frame fitted to n of them is as good as from n / inflation independent ones. Residuals
/// along the sequence of each drive (outliers left out) say by how much (EstimateCorrelatedNoise),
/// with shift, turn and scale as unknowns horizontally, shift and tilt vertically. `problem` holds
/// the adjusted poses and the priors (AddGnss). Ones without priors. Linear in the images.
[[nodiscard]] GnssVariance EstimateGnssVariance(const GlobalProblem& problem,
                                                const std::vector<Eigen::Vector3d>& biases_m,
                                                const ImageManifest& manifest);

}  // namespace orbweave
