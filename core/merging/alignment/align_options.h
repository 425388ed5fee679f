// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

struct AlignOptions {
  int min_common_images = 3;
  double max_error_px = 8.0;
  double drift_deg = 0.5;
  double drift_share = 0.01;
  double max_contradiction = 8.0;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("min_common_images",
          self.min_common_images,
          "seams with fewer common images need common tracks that agree",
          Range{1, 1000});
    visit("max_error_px",
          self.max_error_px,
          "common tracks further apart do not vote on a seam",
          Range{0.1, 1000});
    visit("drift_deg",
          self.drift_deg,
          "expected bend of a submodel from end to end",
          Range{0.001, 90});
    visit("drift_share",
          self.drift_share,
          "expected stretch of a submodel, share of its extent",
          Range{0.00001, 1});
    visit("max_contradiction",
          self.max_contradiction,
          "seams that loops contradict by more times the expected drift are switched off",
          Range{1, 1000});
  }
};

}  // namespace orbweave
