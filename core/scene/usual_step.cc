// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/usual_step.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

/// Up to nine steps in ten may be those of a camera that stands, which are a tenth of a long one or
/// less.
constexpr double kHardlyAnyLonger = 0.9;
constexpr double kStanding = 0.1;

}  // namespace

double DistanceBetween(const PosePrior& a, const PosePrior& b) {
  return (*a.position_in_enu - *b.position_in_enu).head<2>().norm();
}

double SigmaBetween(const PosePrior& a, const PosePrior& b) {
  return std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m);
}

double UsualStep(std::vector<double> steps) {
  const double standing = kStanding * Quantile(steps, kHardlyAnyLonger);
  std::erase_if(steps, [&](double step) { return step < standing; });
  return Quantile(std::move(steps), 0.5);
}

double UsualStep(std::span<const PosePrior* const> sequence) {
  std::vector<double> steps;
  for (size_t i = 0; i + 1 < sequence.size(); ++i) {
    if (sequence[i]->position_in_enu && sequence[i + 1]->position_in_enu)
      steps.push_back(DistanceBetween(*sequence[i], *sequence[i + 1]));
  }
  return UsualStep(std::move(steps));
}

}  // namespace orbweave
