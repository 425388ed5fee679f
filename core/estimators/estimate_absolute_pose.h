// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

struct AbsolutePoseOptions {
  double confidence = 0.9999;
  int max_trials = 10000;
  int min_inliers = 6;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("confidence",
          self.confidence,
          "RANSAC stops once the best pose is found with this probability",
          Range{0.5, 0.999999});
    visit("max_trials", self.max_trials, "RANSAC trials at most", Range{10, 10000000});
    visit(
        "min_inliers", self.min_inliers, "poses with fewer inliers are no answer", Range{4, 10000});
  }
};

struct AbsolutePose {
  Rigid3 cam_from_world{};
  std::vector<uint8_t> is_inlier{};  ///< per correspondence
  uint32_t num_inliers = 0;
};

/// Pose of a panorama from rays and the scene points they see: P3P, RANSAC with local optimisation,
/// angular error (10) below max_error_rad, refined on the inliers. nullopt: fewer than
/// options.min_inliers agree. `bearings` unit, in the camera frame; same length as points_in_world.
[[nodiscard]] absl::StatusOr<std::optional<AbsolutePose>> EstimateAbsolutePose(
    std::span<const Eigen::Vector3d> bearings,
    std::span<const Eigen::Vector3d> points_in_world,
    double max_error_rad,
    const AbsolutePoseOptions& options,
    const StageContext& context);

/// Least-squares pose (tangent-plane residuals, Cauchy loss at max_error_rad / 2) from `initial`
/// over the correspondences with is_inlier set (all, when empty).
[[nodiscard]] Rigid3 RefineAbsolutePose(const Rigid3& initial,
                                        std::span<const Eigen::Vector3d> bearings,
                                        std::span<const Eigen::Vector3d> points_in_world,
                                        std::span<const uint8_t> is_inlier,
                                        double max_error_rad);

}  // namespace orbweave
