// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/base/options.h"

namespace orbweave {

/// What is to be seen straight below the camera.
enum class NadirKind {
  kRoof,     ///< the carrier's roof, one metre below
  kNone,     ///< the ground
  kBlack,    ///< nothing, from 45 degrees below the horizon on, as many providers deliver
  kBlurred,  ///< a blur over roof and ground, from 45 degrees below the horizon on
};

template <>
struct EnumNames<NadirKind> {
  static constexpr std::array<std::pair<NadirKind, std::string_view>, 4> kNames = {
      {{NadirKind::kRoof, "roof"},
       {NadirKind::kNone, "none"},
       {NadirKind::kBlack, "black"},
       {NadirKind::kBlurred, "blurred"}}};
};

/// What real streets have and a rendered one need not. At their defaults all are absent; each
/// changes what it says and nothing else.
struct StreetHardships {
  bool room = false;
  bool standing = false;
  int stop_panoramas = 0;
  double spacing_spread = 0.0;
  double plain_share = 0.0;
  double reflection = 0.0;
  bool equal_windows = false;
  double repeat_share = 0.0;
  double wind_m = 0.0;
  double second_day_share = 0.0;
  int pedestrians = 0;
  int vehicles = 0;
  bool bus_ahead = false;
  double harsh_light = 0.0;
  double daylight = 1.0;
  double white_balance_spread = 0.0;
  double vignetting = 0.0;
  double shade_noise_levels = 0.0;
  double shade_blur_px = 0.0;
  double lens_offset_m = 0.0;
  double rolling_shutter_s = 0.0;
  double speed_mps = 8.0;
  NadirKind nadir = NadirKind::kRoof;
  int jpeg_quality = 95;
  double gnss_multipath_m = 0.0;
  double gnss_late_s = 0.0;
  double gnss_datum_m = 0.0;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    VisitScene(self, visit);
    VisitCamera(self, visit);
    visit("gnss_multipath_m",
          self.gnss_multipath_m,
          "GNSS error that stays for 60 m of the way; 1.5 times as much vertically",
          Range{0, 50});
    visit("gnss_late_s", self.gnss_late_s, "positions are those of so long ago", Range{-5, 5});
    visit("gnss_datum_m",
          self.gnss_datum_m,
          "heights of the second day are over a datum so much lower",
          Range{-100, 100});
  }

 private:
  template <typename Self, typename Visitor>
  static void VisitScene(Self& self, Visitor&& visit) {
    visit("room", self.room, "a furnished room instead of a street");
    visit("standing", self.standing, "the camera never moves");
    visit("stop_panoramas",
          self.stop_panoramas,
          "panoramas that the camera stands for, half of the others later",
          Range{0, 10000});
    visit("spacing_spread",
          self.spacing_spread,
          "largest change of a step, as a share of the spacing",
          Range{0, 0.8});
    visit("plain_share",
          self.plain_share,
          "share of houses of even plaster; the ground loses that share of its contrast",
          Range{0, 1});
    visit("reflection", self.reflection, "panes and paint mirror the street", Range{0, 1});
    visit("equal_windows", self.equal_windows, "all windows of a house are the same");
    visit("repeat_share",
          self.repeat_share,
          "share of houses that are the same as the one before",
          Range{0, 1});
    visit("wind_m",
          self.wind_m,
          "crowns of trees move, their leaves turn, clouds go by",
          Range{0, 1});
    visit("second_day_share",
          self.second_day_share,
          "share of panoramas, in stretches, of a day of other light, parked cars and shop fronts",
          Range{0, 1});
    visit("pedestrians", self.pedestrians, "people near each panorama", Range{0, 200});
    visit("vehicles", self.vehicles, "more moving vehicles near each panorama", Range{0, 8});
    visit("bus_ahead", self.bus_ahead, "one bus stays 5 m ahead of the camera all the way");
  }

  template <typename Self, typename Visitor>
  static void VisitCamera(Self& self, Visitor&& visit) {
    visit("harsh_light",
          self.harsh_light,
          "share of skylight missing in the shade; the sky is overexposed",
          Range{0, 0.9});
    visit("daylight",
          self.daylight,
          "share of the light left; the camera's gain makes up for its root, with noise",
          Range{0.01, 1});
    visit("white_balance_spread",
          self.white_balance_spread,
          "largest change of red and blue against green between panoramas",
          Range{0, 0.5});
    visit("vignetting",
          self.vignetting,
          "share of light lost 45 degrees off the axis of each of six lenses",
          Range{0, 0.9});
    visit("shade_noise_levels",
          self.shade_noise_levels,
          "sensor noise added where it is dark, in 8-bit levels",
          Range{0, 50});
    visit("shade_blur_px",
          self.shade_blur_px,
          "standard deviation of the blur where it is dark",
          Range{0, 10});
    visit("lens_offset_m",
          self.lens_offset_m,
          "distance of the six lenses from the point where the panorama is said to be taken",
          Range{0, 0.5});
    visit("rolling_shutter_s",
          self.rolling_shutter_s,
          "time between the first and the last row; the truth is of the middle row's",
          Range{0, 0.2});
    visit("speed_mps", self.speed_mps, "speed of the carrier", Range{0.1, 40});
    visit("nadir", self.nadir, "what is to be seen below the camera");
    visit("jpeg_quality", self.jpeg_quality, "of the panoramas", Range{1, 100});
  }
};

}  // namespace orbweave
