// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/merging/checks/inspect_subproblem.h"
#include "core/merging/georeference/global_problem.h"
#include "core/partitioned_ba/global_options.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// What is known of the errors of a world's poses.
struct AssessedWorld {
  std::map<ImageId, PoseUncertainty> uncertainties{};  ///< of images with observations; held: zero
  UncertaintyReport report{};
};

/// The uncertainty of the poses of an adjusted world: what its subproblems' bearings say of poses
/// (InspectSubproblem), in their order, is added - every panorama's bearings weighted by their own
/// scatter, so that a place where they scatter more claims less, and all by how errors go together
/// along tracks (TrackCorrelation) and within patches of panoramas (JudgeSupport; the mean of all,
/// as the error of one moves its neighbours) -, and the normal equations of all poses with GNSS and
/// gravity terms give the covariances (CovariancesOfSystem). Where errors go together more than on
/// average, what they move the panorama itself is added: the frame is known no worse for it. Memory
/// grows with the panoramas, not with the points. GNSS errors count as correlated as they are found
/// along the sequence (EstimateGnssVariance): an offset common to all positions shows nowhere.
/// `supports`: what all subproblems together say of each image that they support. `problem` holds
/// the world's poses and GNSS terms (AddGnss), `biases_m` are those of its drives.
[[nodiscard]] AssessedWorld AssessWorld(std::vector<SubproblemInspection> subproblems,
                                        const std::map<ImageId, SupportVerdict>& supports,
                                        const GlobalProblem& problem,
                                        const std::vector<Eigen::Vector3d>& biases_m,
                                        const ImageManifest& manifest);

}  // namespace orbweave
