// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/geometry/sim3.h"
#include "core/merging/fit_seams.h"

namespace orbweave {

struct AlignOptions {
  int min_common_images = 3;
  double max_error_px = 8.0;
  double drift_deg = 0.5;
  double drift_share = 0.01;
  double max_contradiction = 8.0;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("min_common_images",
          self.min_common_images,
          "seams with fewer common images need common tracks that agree",
          Range{1, 1000});
    visit("max_error_px",
          self.max_error_px,
          "common tracks further apart do not vote on a seam",
          Range{0.1, 1000});
    visit("drift_deg",
          self.drift_deg,
          "expected bend of a submodel from end to end",
          Range{0.001, 90});
    visit("drift_share",
          self.drift_share,
          "expected stretch of a submodel, share of its extent",
          Range{0.00001, 1});
    visit("max_contradiction",
          self.max_contradiction,
          "seams that loops contradict by more times the expected drift are switched off",
          Range{1, 1000});
  }
};

/// How well two submodels fit; indices into the submodel list, a < b.
struct SeamReport {
  uint32_t submodel_a = 0;
  uint32_t submodel_b = 0;
  uint32_t common_images = 0;
  uint32_t common_tracks = 0;
  uint32_t inlier_tracks = 0;
  double condition_number = 0.0;
  bool used = true;
  bool contradicted = false;  ///< by loops, hence not used
  std::string reason{};       ///< why it is not used
  double position_jump_m =
      0.0;  ///< median distance of common centres after alignment, units of the world
  double rotation_jump_deg = 0.0;  ///< median
};

/// Whose part a submodel is, and how many images it holds.
struct SubmodelExtent {
  uint32_t cluster = 0;
  uint32_t num_images = 0;
};

/// World frames: connected submodels share one.
struct Alignment {
  std::vector<Sim3> world_from_submodel{};
  std::vector<uint32_t> world{};  ///< per submodel: index of its world, 0 has the most images
  std::vector<SubmodelExtent> submodels{};
  std::vector<SeamReport> seams{};  ///< every two submodels with a common image, sorted by (a, b)
};

/// Places all submodels, whose frames and scales are their own.
///
/// Seam by seam FitSeams has found a robust relative Sim3 from common images (rotation, centre) and
/// common tracks, in units of the bearings' standard deviations, hence independent of any scale. A
/// seam is used when enough images or tracks agree on it and its information matrix is
/// well-conditioned; otherwise its report says why not.
///
/// All seams together: one robust pose graph (AverageSimilarities). A seam itself is known to
/// millimetres, the submodels between two seams bend and stretch by more: each seam's covariance is
/// its own plus drift_deg and drift_share of the submodels' extent. Loops spread their error; a
/// seam that loops contradict by more than max_contradiction such standard deviations is switched
/// off.
///
/// World 0 holds most images; submodels that no used seam joins are worlds of their own. A world
/// has the frame and scale of its submodel with most images. GNSS enters when they are joined.
/// `clusters`: in order; memory grows with images and seams, not with points. InvalidArgument: a
/// seam of a submodel that is not there. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<Alignment> AlignSubmodels(std::span<const SeamsOfCluster> clusters,
                                                       const AlignOptions& options,
                                                       const StageContext& context);

}  // namespace orbweave
