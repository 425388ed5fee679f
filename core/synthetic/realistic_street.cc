// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/realistic_street.h"

namespace orbweave {

StreetOptions RealisticStreet(StreetOptions options) {
  options.exposure_spread = 0.25;
  options.mask_moving_cars = false;  // who maps a town has masks of the carrier at best
  options.hardships = {.spacing_spread = 0.15,
                       .plain_share = 0.85,
                       .reflection = 1.0,
                       .repeat_share = 0.25,
                       .wind_m = 0.12,
                       .second_day_share = 0.3,
                       .pedestrians = 12,
                       .vehicles = 2,
                       .harsh_light = 0.25,
                       .white_balance_spread = 0.06,
                       .vignetting = 0.2,
                       .shade_noise_levels = 5.0,
                       .shade_blur_px = 0.8,
                       .lens_offset_m = 0.04,  // of a head of six lenses with 15 cm across
                       .rolling_shutter_s = 0.016,
                       .nadir = NadirKind::kBlurred,
                       .jpeg_quality = 75,
                       .gnss_multipath_m = 2.0,
                       .gnss_late_s = 0.2,
                       .gnss_datum_m = 40.0};  // heights of the ellipsoid and of the geoid
  return options;
}

StreetOptions RoomOptions(StreetOptions options) {
  options.spacing_m = 0.7;
  options.gnss_sigma_m = 12.0;
  options.gnss_gap_share = 0.0;
  options.hardships.room = true;
  options.hardships.speed_mps = 0.5;
  options.hardships.nadir = NadirKind::kBlack;
  return options;
}

}  // namespace orbweave
