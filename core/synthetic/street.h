// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/random.h"
#include "core/geometry/rigid3.h"
#include "core/scene/image_manifest.h"
#include "core/synthetic/street_hardships.h"
#include "core/synthetic/street_world.h"

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
    visit("spacing_m", self.spacing_m, "distance between panoramas", Range{0.2, 20});
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

/// A street and the drive through it. Poses and positions are in the east-north-up frame at
/// `origin`, which differs from the street's frame by a translation.
struct Street {
  StreetWorld world;
  std::vector<std::string> names{};  ///< street_0000.jpg, ...
  std::vector<double> stations_m{};  ///< arc length along the axis
  std::optional<StreetWorld> second_day{};
  std::vector<bool> on_second_day{};
  std::vector<double> capture_times_s{};                    ///< since 1970
  Eigen::Vector3d street_in_enu = Eigen::Vector3d::Zero();  ///< origin of the street's frame
  std::vector<Rigid3> cams_from_enu{};                      ///< truth
  /// Median of the measured positions: the origin that an honest reader of the GNSS table would
  /// choose as well.
  GeodeticPosition origin{};
  std::vector<std::optional<Eigen::Vector3d>> measured_in_enu{};  ///< GNSS; absent in the gap

  /// What stood there when panorama i was taken.
  [[nodiscard]] const StreetWorld& WorldOf(size_t i) const {
    return on_second_day[i] ? *second_day : world;
  }
};

/// Places houses, camera and measurements; renders nothing.
[[nodiscard]] Street MakeStreet(const StreetOptions& options);

/// Independent random numbers for each purpose and panorama of a street.
[[nodiscard]] Random RandomForStreet(const StreetOptions& options,
                                     const std::string& purpose,
                                     size_t i = 0);

}  // namespace orbweave
