// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/depth_score.h"

#include <algorithm>
#include <cstdio>

namespace orbweave {
namespace {

constexpr std::array kTolerances_m = {0.02, 0.05, 0.10};

double Percent(size_t part, size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void DepthScore::AddPoint(double error_m, double along_m, double sigma_m) {
  errors_m_.push_back(error_m);
  within_one_sigma_ += along_m < sigma_m ? 1 : 0;
  within_two_sigmas_ += along_m < 2.0 * sigma_m ? 1 : 0;
}

void DepthScore::AddPlace(double error_m) {
  ++places_;
  for (size_t k = 0; k < kTolerances_m.size(); ++k)
    found_[k] += error_m >= 0.0 && error_m < kTolerances_m[k] ? 1 : 0;
}

void DepthScore::Print(const std::string& what) const {
  if (errors_m_.empty()) return;
  std::vector<double> sorted = errors_m_;
  std::ranges::sort(sorted);
  std::printf("  %-17s %7zu points, precision", what.c_str(), sorted.size());
  for (const double tolerance_m : kTolerances_m) {
    const auto end = std::ranges::lower_bound(sorted, tolerance_m);
    std::printf(" %5.1f", Percent(static_cast<size_t>(end - sorted.begin()), sorted.size()));
  }
  if (places_ > 0) {
    std::printf(", recall");
    for (const size_t found : found_) std::printf(" %5.1f", Percent(found, places_));
  }
  std::printf(", median %.1f mm, within one sigma %4.1f two %4.1f\n",
              1e3 * sorted[sorted.size() / 2],
              Percent(within_one_sigma_, sorted.size()),
              Percent(within_two_sigmas_, sorted.size()));
}

}  // namespace orbweave
