// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/features/nearest_two.h"
#include "core/geometry/rigid3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

struct MatchOptions {
  double max_ratio = 0.8;
  double max_distance = 0.7;
  bool cross_check = true;
  bool guided = true;
  double guided_max_ratio = 0.8;
  double guided_max_wrong_share = 0.2;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_ratio",
          self.max_ratio,
          "largest ratio of best to second-best descriptor distance",
          Range{0.1, 1.0});
    visit("max_distance",
          self.max_distance,
          "largest distance of unit descriptors",
          Range{0.01, 2.0});
    visit("cross_check", self.cross_check, "a match must be the best in both directions");
    visit("guided", self.guided, "match again along epipolar planes once the geometry is known");
    visit("guided_max_ratio",
          self.guided_max_ratio,
          "ratio test among candidates near the epipolar plane",
          Range{0.1, 1.0});
    visit("guided_max_wrong_share",
          self.guided_max_wrong_share,
          "share of guided matches that planes of a wrong geometry would have found as well",
          Range{0.0, 1.0});
  }
};

/// Nearest-neighbour matches of two panoramas by descriptor distance, sorted by (a, b). With cross
/// check both directions must pass all tests, so exchanging the panoramas exchanges the result.
/// Empty when either has no descriptors. The same on every machine: integer arithmetic.
[[nodiscard]] std::vector<FeatureMatch> MatchDescriptors(const Features& a,
                                                         const Features& b,
                                                         const MatchOptions& options);

/// The same from nearest neighbours that were found already.
[[nodiscard]] std::vector<FeatureMatch> AcceptNearest(const NearestTwoBothWays& nearest,
                                                      const MatchOptions& options);

/// Matches among features whose bearings lie within `max_error_rad` of each other's epipolar plane
/// under b_from_a and in front of both spheres: the nearest by descriptor among those candidates,
/// by `guided_max_ratio`, `max_distance` and cross check. There are few candidates in a plane, so
/// an unmatched feature easily finds one by chance: the ratio is what keeps such matches out.
/// Sorted by (a, b), one-to-one. Empty without a translation (no epipolar planes) or without
/// descriptors.
[[nodiscard]] std::vector<FeatureMatch> MatchGuided(const Features& a,
                                                    const Features& b,
                                                    const Rigid3& b_from_a,
                                                    double max_error_rad,
                                                    const MatchOptions& options);

}  // namespace orbweave
