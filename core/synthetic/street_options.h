// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"
#include "core/synthetic/street_hardships.h"

namespace orbweave {

/// A drive round a block with a panoramic camera, 2.5 m above a street that is rendered; with
/// `hardships.room`, a walk round a room.
struct StreetOptions {
  int panoramas = 48;
  int width_px = 2048;
  double spacing_m = 2.5;
  double tilt_sigma_deg = 1.2;
  double exposure_spread = 0.06;
  double noise_levels = 1.2;
  double gnss_sigma_m = 1.5;
  double gnss_bias_m = 1.0;
  double gnss_outlier_share = 0.06;
  double gnss_gap_share = 0.08;
  bool mask_moving_cars = true;
  int seed = 1;
  StreetHardships hardships{};  ///< validated and visited on their own

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("panoramas", self.panoramas, "number of panoramas", Range{1, 10000});
    visit("width_px",
          self.width_px,
          "width of a panorama; its height is half of it",
          Range{64, 16384});
    visit("spacing_m", self.spacing_m, "distance between panoramas", Range{0.001, 20});
    visit(
        "tilt_sigma_deg", self.tilt_sigma_deg, "pitch, roll and yaw of the carrier", Range{0, 10});
    visit("exposure_spread",
          self.exposure_spread,
          "largest change of gain between panoramas",
          Range{0, 0.5});
    visit("noise_levels", self.noise_levels, "sensor noise in 8-bit levels", Range{0, 50});
    visit("gnss_sigma_m",
          self.gnss_sigma_m,
          "horizontal GNSS noise; 1.5 times as much vertically",
          Range{0, 100});
    visit("gnss_bias_m",
          self.gnss_bias_m,
          "constant horizontal GNSS error of the drive",
          Range{0, 100});
    visit("gnss_outlier_share",
          self.gnss_outlier_share,
          "share of positions that are 15 to 60 m off",
          Range{0, 0.5});
    visit("gnss_gap_share",
          self.gnss_gap_share,
          "share of the drive without reception",
          Range{0, 0.9});
    visit("mask_moving_cars",
          self.mask_moving_cars,
          "masks cover moving cars as well as the carrier's roof");
    visit("seed", self.seed, "another seed, another street", Range{0, 2147483647});
  }
};

}  // namespace orbweave
