// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/geometry/sim3.h"

namespace orbweave {

/// Least-squares similarity with b ~ b_from_a * a over weighted point pairs; Umeyama, PAMI 1991.
/// `weights` empty: all one. nullopt for fewer than three pairs or collinear points.
[[nodiscard]] std::optional<Sim3> FitSimilarity(std::span<const Eigen::Vector3d> points_in_a,
                                                std::span<const Eigen::Vector3d> points_in_b,
                                                std::span<const double> weights);

struct RobustSimilarity {
  Sim3 b_from_a{};
  std::vector<uint8_t> is_inlier{};
  uint32_t num_inliers = 0;
};

/// The similarity most point pairs agree on within max_error (units of b), RANSAC with local
/// optimisation; nullopt when fewer than three agree. `context.seed` seeds the sampler.
[[nodiscard]] absl::StatusOr<std::optional<RobustSimilarity>> EstimateSimilarity(
    std::span<const Eigen::Vector3d> points_in_a,
    std::span<const Eigen::Vector3d> points_in_b,
    double max_error,
    const StageContext& context);

}  // namespace orbweave
