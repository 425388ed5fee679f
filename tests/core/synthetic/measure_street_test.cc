// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/measure_street.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/synthetic/make_street.h"
#include "core/synthetic/simulate_gnss.h"

namespace orbweave {
namespace {

/// A street on which GNSS is exact but for the hardships.
StreetOptions Exact(const StreetHardships& hardships) {
  return {.panoramas = 100,
          .gnss_sigma_m = 0.0,
          .gnss_bias_m = 0.0,
          .gnss_outlier_share = 0.0,
          .gnss_gap_share = 0.0,
          .hardships = hardships};
}

/// Error of panorama i in the street's frame.
Eigen::Vector3d ErrorOf(const Street& street, size_t i) {
  return *street.measured_in_enu[i] - street.cams_from_enu[i].Centre();
}

TEST(MeasureStreet, LatePositionsAreThoseOfTheWayBehind) {
  const Street street = MakeStreet(Exact({.speed_mps = 10.0, .gnss_late_s = 0.3}));
  int straight = 0;
  for (size_t i = 0; i < 100; ++i) {
    const PathPlace here = street.world.layout.axis.At(street.stations_m[i]);
    const PathPlace before = street.world.layout.axis.At(street.stations_m[i] - 3.0);
    if (here.direction.dot(before.direction) < 1.0 - 1e-12) continue;
    ++straight;
    EXPECT_NEAR(ErrorOf(street, i).head<2>().dot(here.direction), -3.0, 1e-9);
    EXPECT_NEAR(ErrorOf(street, i).head<2>().dot(here.Left()), 0.0, 1e-9);
  }
  EXPECT_GT(straight, 60);
}

TEST(MeasureStreet, OnlyTheSecondDaysHeightsAreOfAnotherDatum) {
  const Street street = MakeStreet(Exact({.second_day_share = 0.4, .gnss_datum_m = 40.0}));
  for (size_t i = 0; i < 100; ++i) {
    const Eigen::Vector3d expected(0.0, 0.0, street.on_second_day[i] ? 40.0 : 0.0);
    EXPECT_LT((ErrorOf(street, i) - expected).norm(), 1e-9) << i;
  }
}

TEST(MeasureStreet, WithoutHardshipsIsExactWhereNothingElseIsAsked) {
  const Street street = MakeStreet(Exact({}));
  for (size_t i = 0; i < 100; ++i) EXPECT_LT(ErrorOf(street, i).norm(), 1e-9);
}

TEST(SimulateGnss, MultipathStaysForItsLengthAndHasItsSize) {
  std::vector<Eigen::Vector3d> truth;
  for (int i = 0; i < 40000; ++i) truth.emplace_back(3.0 * i, 0.0, 0.0);
  const auto measured =
      SimulateGnss(truth, {.sigma_m = 0.0, .multipath_m = 4.0, .multipath_length_m = 60.0}, 5);
  double square = 0.0;
  double square_up = 0.0;
  double product = 0.0;
  constexpr size_t kLag = 20;  // 60 m
  for (size_t i = 0; i + kLag < truth.size(); ++i) {
    const double here = (measured[i] - truth[i]).x();
    square += here * here;
    square_up += std::pow((measured[i] - truth[i]).z(), 2);
    product += here * (measured[i + kLag] - truth[i + kLag]).x();
  }
  // About 1000 independent values: 3 % of sigma, 5 % of correlation.
  const double n = static_cast<double>(truth.size() - kLag);
  EXPECT_NEAR(std::sqrt(square / n), 4.0, 0.4);
  EXPECT_NEAR(std::sqrt(square_up / n), 6.0, 0.6);
  EXPECT_NEAR(product / square, std::exp(-1.0), 0.12);
}

}  // namespace
}  // namespace orbweave
