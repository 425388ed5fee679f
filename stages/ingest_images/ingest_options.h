// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"
#include "core/io/gnss/geoid_heights.h"

namespace orbweave {

template <>
struct EnumNames<HeightDatum> {
  static constexpr std::array<std::pair<HeightDatum, std::string_view>, 3> kNames = {
      {{HeightDatum::kEllipsoid, "ellipsoid"},
       {HeightDatum::kEgm96, "egm96"},
       {HeightDatum::kEgm2008, "egm2008"}}};
};

struct IngestOptions {
  double gnss_sigma_m = 5.0;
  double gnss_vertical_factor = 2.0;
  double heading_sigma_deg = 10.0;
  double tilt_sigma_deg = 3.0;
  double drive_gap_s = 600.0;
  HeightDatum height = HeightDatum::kEllipsoid;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("gnss_sigma_m",
          self.gnss_sigma_m,
          "horizontal standard deviation of positions that state none, metres",
          Range{0.001, 10000});
    visit("gnss_vertical_factor",
          self.gnss_vertical_factor,
          "vertical over horizontal standard deviation",
          Range{0.1, 100});
    visit("heading_sigma_deg",
          self.heading_sigma_deg,
          "standard deviation of headings that state none",
          Range{0.001, 180});
    visit("tilt_sigma_deg",
          self.tilt_sigma_deg,
          "standard deviation of pitch and roll that state none",
          Range{0.001, 180});
    visit("drive_gap_s",
          self.drive_gap_s,
          "a longer pause between two images begins a new drive",
          Range{0.001, 1e9});
    visit("height", self.height, "what altitudes are counted from: the ellipsoid, or a geoid");
  }
};

}  // namespace orbweave
