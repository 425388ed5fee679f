// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

enum class TwoViewSolver { kFivePoint, kEightPoint, kUprightThreePoint };

template <>
struct EnumNames<TwoViewSolver> {
  static constexpr std::array<std::pair<TwoViewSolver, std::string_view>, 3> kNames = {
      {{TwoViewSolver::kFivePoint, "five_point"},
       {TwoViewSolver::kEightPoint, "eight_point"},
       {TwoViewSolver::kUprightThreePoint, "upright_three_point"}}};
};

struct TwoViewOptions {
  TwoViewSolver solver = TwoViewSolver::kFivePoint;
  double max_error_px = 4.0;
  int min_inliers = 10;
  double max_log10_false_alarms = -4.0;
  double min_inlier_share = 0.0;
  double confidence = 0.9999;
  int max_trials = 10000;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("solver", self.solver, "minimal solver of the essential matrix");
    visit("max_error_px",
          self.max_error_px,
          "distance to the epipolar plane, pixels at the equator (8)",
          Range{0.1, 100});
    visit("min_inliers", self.min_inliers, "pairs with fewer inliers are dropped", Range{5, 10000});
    visit("max_log10_false_alarms",
          self.max_log10_false_alarms,
          "pairs are kept when as many matches agree by chance in one of 10^-this pairs at most",
          Range{-1000, 1000});
    visit("min_inlier_share",
          self.min_inlier_share,
          "pairs with a smaller share of inliers are dropped",
          Range{0, 1});
    visit("confidence",
          self.confidence,
          "RANSAC stops once the best model is found with this probability",
          Range{0.5, 0.999999});
    visit("max_trials", self.max_trials, "RANSAC trials at most", Range{10, 10000000});
  }
};

/// Relative pose of two panoramas from putative matches by RANSAC with local optimisation on
/// bearings: inliers by the angle to the epipolar plane (7) below `max_error_rad` and by cheirality
/// on both spheres (paper 3.3), refined over all inliers; flags pure rotation and planes. Matches
/// at the same place of both panoramas are set aside where the others have a geometry of their own
/// that covers more of the sphere: they show the carrier, not the scene. A pair in which nothing
/// but the carrier matches has no geometry. Nor does the sky count: clouds drift, and have more
/// features than a street. Where half of the inliers are high up and further away than five
/// baselines, what is left without them decides; where that shows nothing although both panoramas
/// have features below, there is no geometry. What is high and far beyond the rest is left out
/// (WithoutSky) unless it stands still. Cameras are taken to stand upright to a few degrees; turned
/// otherwise they lose far matches of one side at most. No geometry has a pair whose inliers are no
/// evidence (EvidenceOf): that a share of the matches agrees says nothing, since wrong ones are
/// found in any number.
/// `bearings_a`, `bearings_b`: unit bearings of all features of the two images, in their camera
/// frames; `matches` index into them. Returns kind kNone (and num_putative) when no geometry is
/// supported. Cancelled when asked to stop. `context.seed` seeds the sampler.
[[nodiscard]] absl::StatusOr<TwoViewGeometry> EstimateTwoView(
    ImagePair pair,
    std::span<const Eigen::Vector3d> bearings_a,
    std::span<const Eigen::Vector3d> bearings_b,
    std::span<const FeatureMatch> matches,
    double max_error_rad,
    const TwoViewOptions& options,
    const StageContext& context);

}  // namespace orbweave
