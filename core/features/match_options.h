// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

struct MatchOptions {
  double max_ratio = 0.8;
  double max_distance = 0.7;
  bool cross_check = true;
  int largest_first = 2000;
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
    visit("largest_first",
          self.largest_first,
          "features of the largest scales that are matched first; all where these leave doubt",
          Range{0, 65536});
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

}  // namespace orbweave
