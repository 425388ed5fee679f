// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

/// How depths are estimated (EstimateDepths) and checked (CheckDepths).
struct DenseOptions {
  int views = 4;
  int coarse_rounds = 4;
  int middle_rounds = 2;
  int fine_rounds = 2;
  double noise_levels = 0.8;
  double min_zncc = 0.5;
  double max_sigma = 0.05;
  bool planar_prior = true;
  int min_agreeing = 1;
  double min_agreeing_share = 0.5;
  int min_speckle_px = 30;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("views", self.views, "sources that a pixel is matched with", Range{1, 4});
    visit("coarse_rounds", self.coarse_rounds, "rounds at a quarter of the width", Range{1, 20});
    visit("middle_rounds", self.middle_rounds, "rounds at half of the width", Range{1, 20});
    visit("fine_rounds", self.fine_rounds, "rounds at full width", Range{1, 20});
    visit("noise_levels",
          self.noise_levels,
          "contrast, in 8-bit levels, below which texture counts as noise",
          Range{0.1, 20});
    visit("min_zncc",
          self.min_zncc,
          "correlation that a match has at least to stand alone",
          Range{-1, 1});
    visit("max_sigma",
          self.max_sigma,
          "largest sigma of a range, as a share of the range",
          Range{0.001, 1});
    visit("planar_prior",
          self.planar_prior,
          "pixels without texture may lie on planes of their surroundings");
    visit("min_agreeing",
          self.min_agreeing,
          "other panoramas that must have found the same point; one more below 4 degrees of "
          "parallax",
          Range{0, 8});
    visit("min_agreeing_share",
          self.min_agreeing_share,
          "share that must have found the same point of the panoramas that look at it, nothing in "
          "between, from less than twice the distance",
          Range{0, 1});
    visit("min_speckle_px",
          self.min_speckle_px,
          "connected pixels of one surface that are no speckle",
          Range{1, 10000});
  }
};

}  // namespace orbweave
