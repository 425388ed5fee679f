// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/merging/alignment/fit_seam.h"
#include "core/merging/alignment/submodel.h"
#include "core/merging/alignment/submodel_level.h"

namespace orbweave {

/// A submodel as far as its alignment needs it.
struct SubmodelOutline {
  SubmodelName name{};
  std::vector<ImageId> images{};  ///< sorted
  double length = 1.0;            ///< largest distance of a centre from that of the first image
  std::optional<SubmodelLevel> level{};
};

/// What two submodels with a common image say about their relative similarity.
struct FittedSeam {
  /// The pose of an image in both.
  struct SharedPose {
    Rigid3 cam_from_a{};
    Rigid3 cam_from_b{};
  };

  SubmodelName a{};  ///< < b
  SubmodelName b{};
  uint32_t common_tracks = 0;
  std::vector<SharedPose> shared{};  ///< of common images that are loose in neither, by image
  SeamFit fit{};                     ///< where there are such images
  /// Largest distance of a camera centre of either submodel from the chart's anchor, units of a.
  double extent_a = 0.0;
  double extent_b = 0.0;
};

/// One cluster's share of what AlignSubmodels needs.
struct SeamsOfCluster {
  std::vector<SubmodelOutline> submodels{};  ///< of the cluster, by submodel
  std::vector<FittedSeam> seams{};           ///< with each other and with later clusters, by (a, b)
};

/// Outlines of a cluster's submodels (`own`, by submodel) and their seams (FitSeam) with each
/// other and with `later` (sorted by name, of clusters after it). Boundaries (BoundaryTracksOf) are
/// enough. `max_error`: in standard deviations of a bearing. Same bytes for any number of threads;
/// Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<SeamsOfCluster> FitSeams(std::span<const Submodel> own,
                                                      std::span<const Submodel> later,
                                                      double max_error,
                                                      const StageContext& context);

}  // namespace orbweave
