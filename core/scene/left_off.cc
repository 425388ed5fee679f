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

}  // namespace

std::vector<uint8_t> LeftOffBehind(std::span<const PosePrior* const> sequence) {
  std::vector<uint8_t> left_off(sequence.size(), 0);
  const double usual_step = UsualStep(sequence);
  const auto are_apart = [&](size_t i, size_t j) {
    const PosePrior& a = *sequence[i];
    const PosePrior& b = *sequence[j];
    return DistanceBetween(a, b) > kUsualSteps * usual_step + kSigmas * SigmaBetween(a, b);
  };
  std::vector<size_t> placed;
  for (size_t i = 0; i < sequence.size(); ++i) {
    if (sequence[i]->position_in_enu) placed.push_back(i);
  }
  for (size_t p = 0; p + 1 < placed.size(); ++p) {
    const size_t before = placed[p];
    const size_t behind = placed[p + 1];
    left_off[before] = behind == before + 1 && are_apart(before, behind) &&
                       (p == 0 || are_apart(placed[p - 1], behind)) &&
                       (p + 2 == placed.size() || are_apart(before, placed[p + 2]));
  }
  return left_off;
}

}  // namespace orbweave
