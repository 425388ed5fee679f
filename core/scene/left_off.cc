// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/left_off.h"

#include <cstddef>

#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

/// Panoramas see along a street what those up to three places on see too.
constexpr double kUsualSteps = 3.0;
constexpr double kSigmas = 3.0;

bool HavePositions(const PosePrior& a, const PosePrior& b) {
  return a.position_in_enu && b.position_in_enu;
}

}  // namespace

std::vector<uint8_t> LeftOffBehind(std::span<const PosePrior* const> sequence) {
  std::vector<uint8_t> left_off(sequence.size(), 0);
  const double usual_step = UsualStep(sequence);
  const auto are_apart = [&](size_t i, size_t j) {
    const PosePrior& a = *sequence[i];
    const PosePrior& b = *sequence[j];
    return HavePositions(a, b) &&
           DistanceBetween(a, b) > kUsualSteps * usual_step + kSigmas * SigmaBetween(a, b);
  };
  for (size_t i = 0; i + 1 < sequence.size(); ++i) {
    left_off[i] = are_apart(i, i + 1) && (i == 0 || are_apart(i - 1, i + 1)) &&
                  (i + 2 == sequence.size() || are_apart(i, i + 2));
  }
  return left_off;
}

}  // namespace orbweave
