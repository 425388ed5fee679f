// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

enum class MappingPreset { kOrbweave, kPaper };

template <>
struct EnumNames<MappingPreset> {
  static constexpr std::array<std::pair<MappingPreset, std::string_view>, 2> kNames = {
      {{MappingPreset::kOrbweave, "orbweave"}, {MappingPreset::kPaper, "paper"}}};
};

/// How a model is begun: image by image from a seed pair, or with all images at once from their
/// pairs (StartGlobally); auto: globally where the result proves good, else from a seed.
enum class MappingStart { kIncremental, kGlobal, kAuto };

template <>
struct EnumNames<MappingStart> {
  static constexpr std::array<std::pair<MappingStart, std::string_view>, 3> kNames = {
      {{MappingStart::kIncremental, "incremental"},
       {MappingStart::kGlobal, "global"},
       {MappingStart::kAuto, "auto"}}};
};

/// Incremental mapping of one cluster; the paper's section 4 with what has been learned since.
struct MappingOptions {
  MappingPreset preset = MappingPreset::kOrbweave;
  MappingStart start = MappingStart::kIncremental;
  int seed_min_inliers = 100;
  double seed_min_angle_deg = 16.0;
  int min_inliers = 20;
  double max_error_px = 4.0;
  double min_angle_deg = 1.5;
  int two_view_below = 2000;
  int local_window = 12;
  double global_growth = 0.1;
  int max_seeds = 8;
  int min_component_images = 3;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit(
        "preset",
        self.preset,
        "orbweave, or the paper's own workflow for comparisons: then two_view.solver=eight_point, "
        "bundle.residual=erp_px and others are the defaults of a command (to see all: orbweave "
        "options --set mapping.preset=paper); what is set by --set or --config counts");
    visit(
        "start",
        self.start,
        "incremental: from a seed pair; global: all images at once; auto: globally where it holds");
    visit("seed_min_inliers",
          self.seed_min_inliers,
          "matches of the seed pair; relaxed when none qualifies",
          Range{8, 100000});
    visit("seed_min_angle_deg",
          self.seed_min_angle_deg,
          "triangulation angle of the seed pair; relaxed when none qualifies",
          Range{0.1, 90});
    visit("min_inliers",
          self.min_inliers,
          "scene points an image must agree with to be registered",
          Range{6, 10000});
    visit("max_error_px",
          self.max_error_px,
          "observations further off are removed, pixels at the equator",
          Range{0.1, 100});
    visit("min_angle_deg",
          self.min_angle_deg,
          "points seen under a smaller angle are removed",
          Range{0.01, 45});
    visit("two_view_below",
          self.two_view_below,
          "images with this many observations of longer tracks keep no points of two",
          Range{0, 1000000});
    visit("local_window",
          self.local_window,
          "images in the local adjustment after each registration",
          Range{2, 1000});
    visit("global_growth",
          self.global_growth,
          "share of new images or points that triggers a global adjustment",
          Range{0.01, 10});
    visit("max_seeds",
          self.max_seeds,
          "seed pairs tried per component before giving up",
          Range{1, 1000});
    visit("min_component_images",
          self.min_component_images,
          "smaller components are not kept",
          Range{2, 1000});
  }
};

}  // namespace orbweave
