// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/measure_street.h"

#include <algorithm>

#include "core/synthetic/random_for_street.h"
#include "core/synthetic/simulate_gnss.h"

namespace orbweave {
namespace {

/// Where the cameras were when the receiver measured.
std::vector<Eigen::Vector3d> WhereMeasured(const Street& street,
                                           std::vector<Eigen::Vector3d> centres,
                                           const StreetHardships& hardships) {
  const double late_m = hardships.standing ? 0.0 : hardships.gnss_late_s * hardships.speed_mps;
  if (late_m == 0.0) return centres;
  const StreetPath& axis = street.world.layout.axis;
  for (size_t i = 0; i < centres.size(); ++i) {
    centres[i].head<2>() +=
        axis.At(street.stations_m[i] - late_m).position - axis.At(street.stations_m[i]).position;
  }
  return centres;
}

}  // namespace

std::vector<std::optional<Eigen::Vector3d>> MeasureStreet(
    const Street& street,
    const std::vector<Eigen::Vector3d>& centres,
    const StreetOptions& options) {
  const StreetHardships& hardships = options.hardships;
  const GnssModel model{.sigma_m = options.gnss_sigma_m,
                        .bias_m = options.gnss_bias_m,
                        .outlier_share = options.gnss_outlier_share,
                        .multipath_m = hardships.gnss_multipath_m};
  const std::vector<Eigen::Vector3d> places = WhereMeasured(street, centres, hardships);
  const std::vector<Eigen::Vector3d> first =
      SimulateGnss(places, model, RandomForStreet(options, "gnss").Next());
  const std::vector<Eigen::Vector3d> second =
      SimulateGnss(places, model, RandomForStreet(options, "gnss of the second day").Next());
  const size_t n = first.size();
  std::vector<std::optional<Eigen::Vector3d>> measured(first.begin(), first.end());
  for (size_t i = 0; i < n; ++i) {
    if (!street.on_second_day[i]) continue;
    measured[i] = second[i] + hardships.gnss_datum_m * Eigen::Vector3d::UnitZ();
  }
  const auto count = static_cast<double>(n);
  const auto gap_first = static_cast<size_t>(count * 2.0 / 3.0 * (1.0 - options.gnss_gap_share));
  const auto gap = static_cast<size_t>(count * options.gnss_gap_share);
  for (size_t i = gap_first; i < std::min(n, gap_first + gap); ++i) measured[i].reset();
  return measured;
}

}  // namespace orbweave
