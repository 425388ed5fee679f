// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/merging/georeference/correlated_noise.h"
#include "core/merging/georeference/global_problem.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// A position that takes part, and those of a drive in sequence.
struct MeasuredFix {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();        ///< from the middle, over the extent
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();  ///< over sigma
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
  double way_m = 0.0;
  bool is_height_known = true;
};
using MeasuredRun = std::vector<MeasuredFix>;

/// How errors of positions hang together (EstimateCorrelatedNoise), those of heights with those
/// along the ground.
struct PositionNoise {
  CorrelatedNoise horizontal{};  ///< with shift, turn and scale as unknowns
  CorrelatedNoise vertical{};    ///< with shift and tilt
};

/// `tilt_information`: what is known of the tilt besides, 1 / rad^2 over the squared extent in
/// metres, times the variance of the residuals.
[[nodiscard]] PositionNoise EstimatePositionNoise(const std::vector<MeasuredRun>& runs,
                                                  double tilt_information);

/// How far GNSS is to be believed about a whole adjusted model.
struct GnssVariance {
  /// Per world axis, x and y equal: by what claimed variances are to be multiplied
  /// (PositionVarianceFactors), times the inflation below.
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  PositionNoise noise{};  ///< lengths in metres along the sequence
};

/// Errors of positions in a row are alike: satellites and houses stay the same for a hundred
/// metres. A frame fitted to n of them is as good as from n / inflation independent ones. Residuals
/// along the sequence of each drive (outliers left out) say by how much (EstimatePositionNoise).
/// `problem` holds the adjusted poses and the priors (AddGnss). Ones without priors. Linear in the
/// images.
[[nodiscard]] GnssVariance EstimateGnssVariance(const GlobalProblem& problem,
                                                const std::vector<Eigen::Vector3d>& biases_m,
                                                const ImageManifest& manifest);

}  // namespace orbweave
