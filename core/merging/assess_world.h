// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/distributed_bundle/separator_system.h"
#include "core/merging/global_options.h"
#include "core/merging/global_problem.h"
#include "core/merging/world_block.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// What is known of the errors of a world's poses.
struct AssessedWorld {
  std::map<ImageId, PoseUncertainty> uncertainties{};  ///< of images with observations; held: zero
  UncertaintyReport report{};
};

/// The uncertainty of the poses of an adjusted world, taken up block by block: a block's points are
/// eliminated on their own, what remains is added, and the normal equations of all poses with GNSS
/// and gravity terms give the covariances (CovariancesOfSystem). Memory grows with the panoramas,
/// not with the points. GNSS errors count as independent from image to image: an offset common to
/// all positions shows nowhere.
class WorldAssessment {
 public:
  /// In order of the blocks.
  void Add(const WorldBlock& block, int num_threads);

  /// `problem` holds the world's poses and GNSS terms (AddGnss), `biases_m` are those of its
  /// drives.
  [[nodiscard]] AssessedWorld Finish(const GlobalProblem& problem,
                                     const std::vector<Eigen::Vector3d>& biases_m,
                                     const ImageManifest& manifest) &&;

 private:
  std::vector<SeparatorSystem> bearings_{};  // least squares; variables: poses, split points
  double sum_of_squares_ = 0.0;
  double redundancy_ = 0.0;  // observations less points
  std::optional<ImageId> held_{};
  std::optional<ImageId> farthest_{};
};

}  // namespace orbweave
