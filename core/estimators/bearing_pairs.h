// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/estimators/pair_kernels.h"
#include "core/geometry/rigid3.h"
#include "core/robust/ransac.h"
#include "core/scene/ids.h"

namespace orbweave {

/// The bearings of matches in random order, one array per coordinate, so that scoring runs over
/// contiguous memory and early rejection sees a fair sample first.
struct BearingPairs {
  std::vector<uint32_t> order{};  ///< order[i]: index of pair i among the matches
  std::array<std::vector<double>, 3> a{};
  std::array<std::vector<double>, 3> b{};

  [[nodiscard]] size_t Size() const { return order.size(); }
  [[nodiscard]] Eigen::Vector3d A(size_t i) const { return {a[0][i], a[1][i], a[2][i]}; }
  [[nodiscard]] Eigen::Vector3d B(size_t i) const { return {b[0][i], b[1][i], b[2][i]}; }
  /// Those from `first` on.
  [[nodiscard]] internal::PairColumns ColumnsFrom(size_t first) const;
};

[[nodiscard]] BearingPairs ArrangePairs(std::span<const Eigen::Vector3d> bearings_a,
                                        std::span<const Eigen::Vector3d> bearings_b,
                                        std::span<const FeatureMatch> matches,
                                        uint64_t seed);

/// The indices of all pairs, ascending.
[[nodiscard]] std::vector<uint32_t> AllOf(const BearingPairs& pairs);

/// Bearings of some pairs, as the solvers take them.
struct SelectedBearings {
  std::vector<Eigen::Vector3d> a{};
  std::vector<Eigen::Vector3d> b{};
};

[[nodiscard]] SelectedBearings SelectPairs(const BearingPairs& pairs,
                                           std::span<const uint32_t> indices);

/// Truncated sum of squared sines of SymmetricEpipolarAngle; nullopt once `gate` has ruled the pose
/// out. |T| = 1. The same for all four poses of an essential matrix.
[[nodiscard]] std::optional<RansacScore> ScoreEpipolar(const BearingPairs& pairs,
                                                       const Rigid3& b_from_a,
                                                       double max_error_rad,
                                                       const EarlyRejection& gate);

/// Indices of the pairs with SymmetricEpipolarAngle below max_error_rad, ascending.
[[nodiscard]] std::vector<uint32_t> EpipolarInliers(const BearingPairs& pairs,
                                                    const Rigid3& b_from_a,
                                                    double max_error_rad);

}  // namespace orbweave
