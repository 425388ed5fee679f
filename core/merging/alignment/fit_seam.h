// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/averaging/similarity_chart.h"
#include "core/merging/alignment/seam_evidence.h"

namespace orbweave {

/// The similarity that fits a seam, and how well it is known.
struct SeamFit {
  SimilarityChart chart{};  ///< chart.a_from_b is the fit; anchored amid the common images
  Matrix7d covariance = Matrix7d::Identity();  ///< in the chart's coordinates, of the fit alone
  double condition_number = 0.0;  ///< of the 7x7 information matrix; infinite if singular
  uint32_t inlier_tracks = 0;     ///< TrackError below max_error
  uint32_t inlier_cameras = 0;    ///< CameraError below 3 max_error
};

/// Robust relative similarity of two submodels from at least one common image.
///
/// Every common image proposes its own relative rotation and centre, with the scale from the median
/// ratio of point distances and from its baselines to the others; so rotations fix the roll that
/// the collinear centres of a straight street leave open. The proposal most tracks and cameras
/// agree with is refined over both with a Cauchy loss whose scale follows the residuals.
/// `max_error`: in standard deviations of a bearing. Deterministic: nothing is drawn at random.
[[nodiscard]] SeamFit FitSeam(const SeamEvidence& evidence, double max_error);

}  // namespace orbweave
