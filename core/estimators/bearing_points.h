// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/robust/ransac.h"

namespace orbweave {

/// Bearings and the points they see in random order, one array per coordinate, so that scoring runs
/// over contiguous memory and early rejection sees a fair sample first. Points and poses are
/// relative to `origin`, one of the points: far from the world's origin no digits are lost.
struct BearingPoints {
  std::vector<uint32_t> order{};  ///< order[i]: index of datum i among the correspondences
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::array<std::vector<double>, 3> b{};
  std::array<std::vector<double>, 3> P{};

  [[nodiscard]] size_t Size() const { return order.size(); }
  [[nodiscard]] Eigen::Vector3d Bearing(size_t i) const { return {b[0][i], b[1][i], b[2][i]}; }
  [[nodiscard]] Eigen::Vector3d Point(size_t i) const { return {P[0][i], P[1][i], P[2][i]}; }
};

[[nodiscard]] BearingPoints ArrangePoints(std::span<const Eigen::Vector3d> bearings,
                                          std::span<const Eigen::Vector3d> points_in_world,
                                          uint64_t seed);

/// Truncated sum of squared chords 2 (1 - cos e), e the angle (10), which tells a direction from
/// its antipode; nullopt once `gate` has ruled the pose out.
[[nodiscard]] std::optional<RansacScore> ScorePose(const BearingPoints& data,
                                                   const Rigid3& cam_from_origin,
                                                   double max_error_rad,
                                                   const EarlyRejection& gate);

/// Indices of the data with an angle (10) below max_error_rad, ascending.
[[nodiscard]] std::vector<uint32_t> PoseInliers(const BearingPoints& data,
                                                const Rigid3& cam_from_origin,
                                                double max_error_rad);

}  // namespace orbweave
