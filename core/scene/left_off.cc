// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/left_off.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

/// Panoramas see along a street what those up to three places on see too.
constexpr double kUsualSteps = 3.0;
constexpr double kSigmas = 3.0;
constexpr double kUsualIntervals = 3.0;
constexpr double kUsualStepsAfterPause = 2.0;

/// `paused_behind`: of each image of the sequence.
std::vector<uint8_t> FindGaps(std::span<const PosePrior* const> sequence,
                              std::span<const uint8_t> paused_behind) {
  std::vector<uint8_t> left_off(sequence.size(), 0);
  const double usual_step = UsualStep(sequence);
  std::vector<size_t> placed;
  for (size_t i = 0; i < sequence.size(); ++i) {
    if (sequence[i]->position_in_enu) placed.push_back(i);
  }
  for (size_t p = 0; p + 1 < placed.size(); ++p) {
    const size_t before = placed[p];
    const size_t behind = placed[p + 1];
    const auto are_apart = [&](size_t i, size_t j) {
      const PosePrior& a = *sequence[i];
      const PosePrior& b = *sequence[j];
      const double gap = paused_behind[before] != 0
                             ? kUsualStepsAfterPause * usual_step
                             : kUsualSteps * usual_step + kSigmas * SigmaBetween(a, b);
      return DistanceBetween(a, b) > gap;
    };
    left_off[before] = behind == before + 1 && are_apart(before, behind) &&
                       (p == 0 || are_apart(placed[p - 1], behind)) &&
                       (p + 2 == placed.size() || are_apart(before, placed[p + 2]));
  }
  return left_off;
}

/// Behind which images nothing was taken for much longer than usual, as far as times tell.
std::vector<uint8_t> PausedBehind(const ImageManifest& manifest,
                                  std::span<const ImageId> sequence) {
  std::vector<std::pair<size_t, double>> intervals;
  std::vector<double> lengths_s;
  for (size_t i = 0; i + 1 < sequence.size(); ++i) {
    const double length_s = manifest.At(sequence[i + 1]).capture_time_s.value_or(NAN) -
                            manifest.At(sequence[i]).capture_time_s.value_or(NAN);
    if (!std::isfinite(length_s)) continue;
    intervals.emplace_back(i, length_s);
    lengths_s.push_back(length_s);
  }
  const double usual_s = UsualStep(lengths_s);
  std::vector<uint8_t> paused(sequence.size(), 0);
  for (const auto& [i, length_s] : intervals) paused[i] = length_s > kUsualIntervals * usual_s;
  return paused;
}

}  // namespace

std::vector<uint8_t> LeftOffBehind(std::span<const PosePrior* const> sequence) {
  return FindGaps(sequence, std::vector<uint8_t>(sequence.size(), 0));
}

std::vector<uint8_t> LeftOffBehind(const ImageManifest& manifest,
                                   std::span<const ImageId> sequence) {
  std::vector<const PosePrior*> priors;
  for (const ImageId image : sequence) priors.push_back(&manifest.At(image).prior);
  return FindGaps(priors, PausedBehind(manifest, sequence));
}

}  // namespace orbweave
