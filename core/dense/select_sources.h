// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/dense/depth_problem.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct SourceOptions {
  int max_sources = 8;
  double min_angle_deg = 2.0;
  double best_angle_deg = 12.0;
  double max_angle_deg = 60.0;
  int max_seeds = 2048;
  double near_m = 1.5;
  double far_m = 40.0;
  int max_width_px = 3072;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_sources",
          self.max_sources,
          "panoramas that one is compared with at most",
          Range{1, 32});
    visit("min_angle_deg",
          self.min_angle_deg,
          "rays that meet at less tell no depth",
          Range{0.1, 30});
    visit("best_angle_deg", self.best_angle_deg, "rays that meet so are preferred", Range{0.1, 60});
    visit("max_angle_deg",
          self.max_angle_deg,
          "rays that meet at more see too different things",
          Range{1, 120});
    visit("max_seeds",
          self.max_seeds,
          "scene points that the depth of a panorama starts from, at most",
          Range{0, 100000});
    visit("near_m",
          self.near_m,
          "nearest surface, where a model has no points to tell",
          Range{0.01, 1000});
    visit("far_m",
          self.far_m,
          "farthest surface, where a model has no points to tell",
          Range{0.1, 10000});
    visit("max_width_px",
          self.max_width_px,
          "wider panoramas are reduced; time and memory grow with the square",
          Range{64, 16384});
  }
};

/// What the depth of one panorama is computed from.
struct SourceChoice {
  ImageId image{};
  std::vector<ImageId> sources{};  ///< most useful first
  std::vector<DepthSeed> seeds{};  ///< most exact first
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  std::string problem{};  ///< why there are no sources, for people; empty when there are
};

/// Chooses for each of `wanted` (ascending) the panoramas to compare it with, among `images`. Where
/// rays to a common point meet at an angle a, seen at ranges r and r', a source scores
///
///   w(a) min(r, r') / max(r, r'),
///
/// w rising from 0 at min_angle_deg to 1 at best_angle_deg and falling to 0 at max_angle_deg, both
/// linear in log a. In each of 24 sectors of the sphere (quarters of cube faces) a source has the
/// root of its sum, and sources are taken greedily so that the sum over sectors of the best four
/// grows most: a camera that moves forward has no parallax ahead, and road and facades want
/// baselines of their own. Ranges reach from half of the near to twice the far points, but to no
/// more than 25 baselines. A panorama without common points is judged by points assumed on surfaces
/// from near_m to far_m around it. Loose images neither get nor are sources.
[[nodiscard]] std::vector<SourceChoice> SelectSources(
    const std::map<ImageId, RegisteredImage>& images,
    std::span<const ImageId> wanted,
    std::span<const Track> tracks,
    const SourceOptions& options);

}  // namespace orbweave
