// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/base/quantile.h"
#include "tests/core/mapping/ray_street.h"

namespace orbweave {

/// A street filmed by a camera that moves `spacing_m` from one panorama to the next, every two of
/// them matched. Pairs of which nine tenths of the matches stay within 4 px of a rotation count as
/// pure rotations, as EstimateTwoView has it.
inline RayStreet MakeSlowStreet(int panoramas, double spacing_m, bool random_rotations = false) {
  constexpr double kMaxErrorPx = 4.0;
  RayStreet world = MakeStreet({.centres = StraightWalk(panoramas, spacing_m),
                                .points_per_metre = 60,
                                .window = panoramas,
                                .outlier_share = 0.01,
                                .random_rotations = random_rotations});
  for (TwoViewGeometry& pair : world.problem.pairs) {
    const auto& a = world.problem.images[pair.pair.a.value];
    const auto& b = world.problem.images[pair.pair.b.value];
    std::vector<double> angles_rad;
    for (const FeatureMatch& match : pair.inliers) {
      angles_rad.push_back(
          AngleBetween(pair.b_from_a.rotation * a.bearings[match.a], b.bearings[match.b]));
    }
    const double limit_rad = kStreetCamera.AngleFromPixels(kMaxErrorPx);
    if (Quantile(angles_rad, 0.9) > limit_rad) continue;
    pair.kind = TwoViewKind::kPureRotation;
    pair.b_from_a.translation.setZero();
    size_t kept = 0;
    for (size_t i = 0; i < angles_rad.size(); ++i) {
      if (angles_rad[i] <= limit_rad) pair.inliers[kept++] = pair.inliers[i];
    }
    pair.inliers.resize(kept);
  }
  return world;
}

}  // namespace orbweave
