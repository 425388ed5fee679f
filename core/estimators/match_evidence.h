// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/estimators/bearing_pairs.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Matches that a pose is found from: any, and one whose rotation is known before.
inline constexpr size_t kPoseSample = 5;
inline constexpr size_t kTurnedSample = 2;

/// How surely matches show two views of one scene.
struct MatchEvidence {
  /// Decimal logarithm of the number of false alarms: how many geometries as well supported as this
  /// one are to be expected among as many matches that are all wrong. Below 0: fewer than one.
  double log10_false_alarms = 0.0;
  double max_error_rad = 0.0;  ///< at which it is least
  uint32_t num_inliers = 0;    ///< independent ones within that error
  uint32_t num_matches = 0;    ///< independent ones
  double chance_share = 1.0;   ///< of wrong matches that lie within that error by chance
};

/// A-contrario test of a relative pose (Moisan and Stival, A probabilistic criterion to detect
/// rigid point matches between two images, IJCV 2004): of n matches k lie within e of the epipolar
/// plane and in front of both spheres; by chance each does with probability p(e). With s matches
/// taken to find the pose (`sample`: five, or two where others predict its rotation),
///   NFA = E (n - s) C(n, k) C(k, s) p^(k - s),
/// least over E = 4 errors e = max_error_rad, 1/2, 1/4 and 1/8 of it. p(e) is counted, not assumed:
/// it is the share of exchanged matches (a of one, b of another) that the pose explains, so that
/// features in a band along the horizon get no credit for lying there. Matches of one thing that
/// may move by itself, such as a car that follows, count as three (PlacePairs); which ones count
/// does not depend on the pose. Degenerate: s matches or fewer have 0.
/// |b_from_a.translation| = 1, or 0 for a pure rotation, whose error is the angle between the rays
/// and whose sample are two matches. Linear in the number of matches.
[[nodiscard]] MatchEvidence EvidenceOf(const BearingPairs& pairs,
                                       const Rigid3& b_from_a,
                                       double max_error_rad,
                                       size_t sample = kPoseSample);

/// The smallest share of n matches that can be evidence, -4 or so, for some pose: below it no trial
/// is worth its time. From the NFA above with the smallest error and the share p = sin(e) / 2 of
/// bearings all over the sphere.
[[nodiscard]] double SmallestTellingShare(size_t num_matches,
                                          double max_error_rad,
                                          double max_log10_false_alarms,
                                          size_t sample = kPoseSample);

}  // namespace orbweave
