// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

struct PairOptions {
  int sequence_window = 10;
  double gnss_radius_m = 20.0;
  int gnss_max_neighbours = 20;
  int gnss_min_neighbours = 6;
  int exhaustive_below = 40;
  double similar_gate_m = 50.0;
  double similar_gate_sigmas = 3.0;
  int first_neighbours = 3;
  int thin_below = 4;
  bool predict = true;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("sequence_window",
          self.sequence_window,
          "following images of the same drive each image is paired with",
          Range{0, 10000});
    visit("gnss_radius_m",
          self.gnss_radius_m,
          "images closer than this by GNSS are paired",
          Range{0, 100000});
    visit("gnss_max_neighbours",
          self.gnss_max_neighbours,
          "nearest GNSS neighbours at most",
          Range{0, 10000});
    visit("gnss_min_neighbours",
          self.gnss_min_neighbours,
          "nearest GNSS neighbours where fewer are within the radius, up to similar_gate_m",
          Range{0, 10000});
    visit("exhaustive_below",
          self.exhaustive_below,
          "jobs of fewer images pair every two",
          Range{0, 10000});
    visit("similar_gate_m",
          self.similar_gate_m,
          "look-alikes, and pairs of a database, further apart by GNSS are not used",
          Range{0, 10000000});
    visit("similar_gate_sigmas",
          self.similar_gate_sigmas,
          "the gate is at least this many times the sum of both GNSS sigmas",
          Range{0, 1000});
    visit("first_neighbours",
          self.first_neighbours,
          "candidates of each kind that an image is matched with first; most others are left out "
          "where these show a strong chain of its drive (0: all at once)",
          Range{0, 10000});
    visit("thin_below",
          self.thin_below,
          "images with fewer verified pairs get twice the candidates (0: none do)",
          Range{0, 10000});
    visit("predict",
          self.predict,
          "pairs that show nothing are matched again where two others say how they are turned");
  }
};

}  // namespace orbweave
