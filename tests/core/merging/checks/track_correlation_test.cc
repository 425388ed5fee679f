// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/track_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

/// Tracks of 4 to 12 images with errors of correlation `r` in two coordinates, less the mean of one
/// and a straight line of the other.
TrackCorrelation CorrelationOf(double r, int num_tracks) {
  Random random(1);
  TrackCorrelation found;
  for (int t = 0; t < num_tracks; ++t) {
    const int n = 4 + t % 9;
    Eigen::MatrixXd errors(n, 2);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 2; ++k) {
        const double fresh = random.Normal();
        errors(i, k) = i == 0 ? fresh : r * errors(i - 1, k) + std::sqrt(1.0 - r * r) * fresh;
      }
    }
    errors.rowwise() -= errors.colwise().mean();
    const Eigen::VectorXd slope =
        Eigen::VectorXd::LinSpaced(n, -0.5 * (n - 1), 0.5 * (n - 1)).normalized();
    errors.col(1) -= slope * slope.dot(errors.col(1));
    std::vector<Eigen::Vector3d> residuals;
    for (int i = 0; i < n; ++i) residuals.emplace_back(errors(i, 0), errors(i, 1), 0.0);
    found.AddTrack(residuals);
  }
  return found;
}

TEST(TrackCorrelation, IndependentErrorsNeedNoInflation) {
  const TrackCorrelation found = CorrelationOf(0.0, 20000);
  EXPECT_LT(found.Correlation(), 0.02);
  EXPECT_LT(found.Inflation(), 1.06);
}

TEST(TrackCorrelation, FindsTheCorrelationThatResidualsHide) {
  for (const double r : {0.3, 0.6, 0.8})
    EXPECT_NEAR(CorrelationOf(r, 20000).Correlation(), r, 0.03) << r;
  EXPECT_GT(CorrelationOf(0.6, 20000).Inflation(), (1.0 + 0.55) / (1.0 - 0.55));
}

TEST(TrackCorrelation, PartsAddUpToTheWhole) {
  TrackCorrelation twice = CorrelationOf(0.5, 2000);
  const double once = twice.Correlation();
  twice.Add(twice);
  EXPECT_NEAR(twice.Correlation(), once, 1e-9);
}

TEST(TrackCorrelation, FewTracksSayNothing) {
  EXPECT_EQ(TrackCorrelation().Inflation(), 1.0);
  EXPECT_EQ(CorrelationOf(0.8, 20).Inflation(), 1.0);
}

}  // namespace
}  // namespace orbweave
