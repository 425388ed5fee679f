// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

struct PairOptions {
  int sequence_window = 10;
  double gnss_radius_m = 20.0;
  int gnss_max_neighbours = 20;
  int exhaustive_below = 40;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("sequence_window", self.sequence_window, "following images of the same drive each image is paired with", Range{0, 10000});
    visit("gnss_radius_m", self.gnss_radius_m, "images closer than this by GNSS are paired", Range{0, 100000});
    visit("gnss_max_neighbours", self.gnss_max_neighbours, "nearest GNSS neighbours at most", Range{0, 10000});
    visit("exhaustive_below", self.exhaustive_below, "jobs of fewer images pair every two", Range{0, 10000});
  }
};

/// Which two panoramas may see the same: union of a sequence window, GNSS neighbours within a radius,
/// and `similar` (per image the most similar others, best first; may be empty) gated by GNSS where both have
/// it. Sorted, without repetition.
[[nodiscard]] std::vector<ImagePair> SelectImagePairs(const ImageManifest& manifest,
                                                      const std::vector<std::vector<ImageId>>& similar,
                                                      const PairOptions& options);

}  // namespace orbweave
