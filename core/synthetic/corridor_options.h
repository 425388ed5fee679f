// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

enum class CorridorShape { kStraight, kBends, kLoop, kGrid, kUturn };

template <>
struct EnumNames<CorridorShape> {
  static constexpr std::array<std::pair<CorridorShape, std::string_view>, 5> kNames = {
      {{CorridorShape::kStraight, "straight"},
       {CorridorShape::kBends, "bends"},
       {CorridorShape::kLoop, "loop"},
       {CorridorShape::kGrid, "grid"},
       {CorridorShape::kUturn, "uturn"}}};
};

/// A street as rays alone, for scale: no pixels are rendered.
struct CorridorOptions {
  int panoramas = 100;
  CorridorShape shape = CorridorShape::kBends;
  double spacing_m = 3.0;
  int features_per_panorama = 731;
  int width_px = 5400;
  double noise_px = 0.5;
  double outlier_share = 0.02;
  double gnss_sigma_m = 2.0;
  double gnss_outlier_share = 0.0;
  double gnss_bias_m = 0.0;
  int gnss_jump_panoramas = 0;
  double gnss_jump_m = 100.0;
  double gnss_correlation_m = 0.0;
  double gnss_delay_s = 0.0;
  double speed_m_per_s = 10.0;
  double speed_spread = 0.0;
  double gnss_left_m = 0.0;
  double gnss_datum_m = 0.0;
  int gnss_held_panoramas = 1;
  bool gnss_heights = true;
  double hill_grade = 0.0;
  double hill_length_m = 400.0;
  double mount_roll_deg = 0.0;
  double mount_pitch_deg = 0.0;
  int drives = 1;
  double lasting_share = 0.3;
  int stop_panoramas = 0;
  int tunnel_panoramas = 0;
  int tunnel_features = 40;
  int repeat_after = 0;
  double repeat_share = 0.5;
  int roof_features = 0;
  double lens_offset_m = 0.0;
  bool random_rotations = false;
  bool descriptors = false;
  int match_window = 8;
  int seed = 1;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("panoramas", self.panoramas, "number of panoramas", Range{1, 1000000});
    visit(
        "shape",
        self.shape,
        "straight; bends; loop: the end meets the start; grid: streets that cross; uturn: out and "
        "back on the other lane");
    visit("spacing_m", self.spacing_m, "distance between panoramas", Range{0.01, 1000});
    visit("features_per_panorama",
          self.features_per_panorama,
          "features per panorama, on average",
          Range{10, 20000});
    visit("width_px",
          self.width_px,
          "width of the panoramas that the noise refers to",
          Range{64, 65536});
    visit("noise_px",
          self.noise_px,
          "standard deviation of a bearing per axis, pixels at the equator",
          Range{0, 100});
    visit(
        "outlier_share", self.outlier_share, "share of wrong matches in each pair", Range{0, 0.95});
    visit("gnss_sigma_m",
          self.gnss_sigma_m,
          "horizontal GNSS noise; twice as much vertically; 0: no GNSS",
          Range{0, 1000});
    visit("gnss_outlier_share",
          self.gnss_outlier_share,
          "share of GNSS positions that are 20 to 100 m off",
          Range{0, 1});
    visit("gnss_bias_m",
          self.gnss_bias_m,
          "length of each drive's constant horizontal GNSS offset",
          Range{0, 1000});
    visit("gnss_jump_panoramas",
          self.gnss_jump_panoramas,
          "so many positions in a row, about the middle, are off by one and the same jump",
          Range{0, 1000000});
    visit("gnss_jump_m", self.gnss_jump_m, "length of that jump", Range{0, 100000});
    visit("gnss_correlation_m",
          self.gnss_correlation_m,
          "distance along the street over which GNSS noise fades to 1/e; 0: it is independent",
          Range{0, 100000});
    visit("gnss_delay_s",
          self.gnss_delay_s,
          "GNSS positions are where the carrier was so long before; images then have times",
          Range{-100, 100});
    visit("speed_m_per_s", self.speed_m_per_s, "speed of the carrier", Range{0.1, 100});
    visit("speed_spread",
          self.speed_spread,
          "by what share the speed rises and falls along the way; images then have times",
          Range{0, 0.9});
    visit("gnss_left_m",
          self.gnss_left_m,
          "how far the antenna is to the left of the camera",
          Range{-100, 100});
    visit("gnss_datum_m",
          self.gnss_datum_m,
          "how much higher the heights of the second drive's positions are",
          Range{-1000, 1000});
    visit("gnss_held_panoramas",
          self.gnss_held_panoramas,
          "so many panoramas in a row have one and the same position: the receiver reports less "
          "often",
          Range{1, 1000});
    visit("gnss_heights", self.gnss_heights, "positions have heights");
    visit(
        "hill_grade",
        self.hill_grade,
        "how steep the street climbs and falls at the most, metres up per metre along it; carriers "
        "lean with it",
        Range{0, 0.5});
    visit("hill_length_m", self.hill_length_m, "from one hill to the next", Range{10, 100000});
    visit("mount_roll_deg",
          self.mount_roll_deg,
          "how far the cameras lean to the right of the direction of travel",
          Range{-90, 90});
    visit("mount_pitch_deg",
          self.mount_pitch_deg,
          "how far the cameras lean backwards, looking up",
          Range{-90, 90});
    visit("drives",
          self.drives,
          "2: the second half of the panoramas drives the street again on another day, 2 m beside",
          Range{1, 2});
    visit("lasting_share",
          self.lasting_share,
          "share of the points that both drives see",
          Range{0, 1});
    visit("stop_panoramas",
          self.stop_panoramas,
          "so many panoramas in the middle of the first drive are taken at one place, trembling by "
          "millimetres",
          Range{0, 1000000});
    visit("tunnel_panoramas",
          self.tunnel_panoramas,
          "so many panoramas in the middle of the street are in a tunnel",
          Range{0, 1000000});
    visit("tunnel_features",
          self.tunnel_features,
          "features per panorama there, along the axis and at little parallax",
          Range{0, 20000});
    visit("repeat_after",
          self.repeat_after,
          "facades repeat after so many panoramas, and panoramas a period apart are matched; 0: "
          "they do not",
          Range{0, 1000000});
    visit("repeat_share", self.repeat_share, "share of the points that repeat", Range{0, 1});
    visit("roof_features",
          self.roof_features,
          "features on the carrier's roof, at the same place of every panorama",
          Range{0, 20000});
    visit("lens_offset_m",
          self.lens_offset_m,
          "distance of five lenses from the head's centre, each of which takes a sector of the "
          "panorama",
          Range{0, 10});
    visit(
        "random_rotations", self.random_rotations, "turn every panorama by a rotation of its own");
    visit("descriptors", self.descriptors, "give features descriptors that tell points apart");
    visit("match_window",
          self.match_window,
          "following panoramas each one is matched with",
          Range{1, 1000});
    visit("seed", self.seed, "another seed, another street", Range{0, 2147483647});
  }
};

}  // namespace orbweave
