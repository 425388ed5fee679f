// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/estimators/bearing_pairs.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// The bearings of two panoramas' features, and how far a match may be off a pose.
struct MatchedBearings {
  std::span<const Eigen::Vector3d> a;
  std::span<const Eigen::Vector3d> b;
  double max_error_rad = 0.0;
  uint64_t seed = 0;  ///< of the order in which matches are arranged

  [[nodiscard]] BearingPairs Arranged(std::span<const FeatureMatch> matches) const;

  /// Indices of the pairs that agree with a geometry: InliersOf its pose, or of a pure rotation
  /// what it takes from one bearing to the other.
  [[nodiscard]] std::vector<uint32_t> Agreeing(const BearingPairs& pairs,
                                               const TwoViewGeometry& geometry) const;

  /// A geometry found of some of `matches`, with all of them that agree with it.
  [[nodiscard]] TwoViewGeometry Extended(TwoViewGeometry geometry,
                                         std::span<const FeatureMatch> matches) const;
};

}  // namespace orbweave
