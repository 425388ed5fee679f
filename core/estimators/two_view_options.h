// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

enum class TwoViewSolver { kFivePoint, kEightPoint, kUprightThreePoint };

template <>
struct EnumNames<TwoViewSolver> {
  static constexpr std::array<std::pair<TwoViewSolver, std::string_view>, 3> kNames = {
      {{TwoViewSolver::kFivePoint, "five_point"},
       {TwoViewSolver::kEightPoint, "eight_point"},
       {TwoViewSolver::kUprightThreePoint, "upright_three_point"}}};
};

struct TwoViewOptions {
  TwoViewSolver solver = TwoViewSolver::kFivePoint;
  double max_error_px = 4.0;
  int min_inliers = 10;
  double max_log10_false_alarms = -4.0;
  double min_inlier_share = 0.0;
  double confidence = 0.9999;
  int max_trials = 10000;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("solver", self.solver, "minimal solver of the essential matrix");
    visit("max_error_px",
          self.max_error_px,
          "distance to the epipolar plane, pixels at the equator (8)",
          Range{0.1, 100});
    visit("min_inliers", self.min_inliers, "pairs with fewer inliers are dropped", Range{5, 10000});
    visit("max_log10_false_alarms",
          self.max_log10_false_alarms,
          "pairs are kept when as many matches agree by chance in one of 10^-this pairs at most",
          Range{-1000, 1000});
    visit("min_inlier_share",
          self.min_inlier_share,
          "pairs with a smaller share of inliers are dropped",
          Range{0, 1});
    visit("confidence",
          self.confidence,
          "RANSAC stops once the best model is found with this probability",
          Range{0.5, 0.999999});
    visit("max_trials", self.max_trials, "RANSAC trials at most", Range{10, 10000000});
  }
};

}  // namespace orbweave
