// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/simulate_gnss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

const std::vector<Eigen::Vector3d> kStanding(4000, Eigen::Vector3d(5.0, 6.0, 7.0));

TEST(SimulateGnss, HasTheNoiseAskedFor) {
  double horizontal = 0.0;
  double vertical = 0.0;
  for (const Eigen::Vector3d& p : SimulateGnss(kStanding, {.sigma_m = 2.0}, 3)) {
    horizontal += (p - kStanding[0]).head<2>().squaredNorm() / 2.0;
    vertical += std::pow(p.z() - 7.0, 2);
  }
  EXPECT_NEAR(std::sqrt(horizontal / 4000.0), 2.0, 0.05);
  EXPECT_NEAR(std::sqrt(vertical / 4000.0), 3.0, 0.12);
}

TEST(SimulateGnss, BiasIsOneForTheWholeDrive) {
  const auto measured = SimulateGnss(kStanding, {.sigma_m = 0.0, .bias_m = 1.5}, 3);
  EXPECT_NEAR((measured[0] - kStanding[0]).norm(), 1.5, 1e-12);
  EXPECT_EQ(measured.front(), measured.back());
}

TEST(SimulateGnss, OutliersAreFarOffAndAsManyAsAsked) {
  int far = 0;
  for (const Eigen::Vector3d& p :
       SimulateGnss(kStanding, {.sigma_m = 0.0, .outlier_share = 0.1}, 3)) {
    const double error_m = (p - kStanding[0]).norm();
    if (error_m == 0.0) continue;
    EXPECT_GE(error_m, 15.0 - 1e-9);
    EXPECT_LE(error_m, 60.0 + 1e-9);
    ++far;
  }
  EXPECT_NEAR(far, 400, 60);
}

TEST(SimulateGnss, IsTheSameForTheSameSeed) {
  EXPECT_EQ(SimulateGnss(kStanding, {}, 3), SimulateGnss(kStanding, {}, 3));
  EXPECT_NE(SimulateGnss(kStanding, {}, 3), SimulateGnss(kStanding, {}, 4));
}

}  // namespace
}  // namespace orbweave
