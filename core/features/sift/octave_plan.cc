// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/octave_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/features/sift/halve_rows.h"

namespace orbweave::internal {
namespace {

constexpr double kSigma0_px = 1.6;
constexpr double kSigma0Full_px = kSigma0_px / std::numbers::sqrt2;
/// Blur that a panorama is taken to have, Lowe, IJCV 2004.
constexpr double kOwnBlur_px = 0.5;
constexpr int kSmallestHeight = 32;

double BlurBetween(double from_px, double to_px) {
  return std::sqrt(to_px * to_px - from_px * from_px);
}

RowRange Grown(const RowRange& rows, int by) { return {rows.begin - by, rows.end + by}; }
RowRange Union(const RowRange& a, const RowRange& b) {
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}
RowRange Clipped(const RowRange& rows, int height) {
  return {std::clamp(rows.begin, 0, height), std::clamp(rows.end, 0, height)};
}

OctavePlan FirstOctave(int width, int height, bool doubled) {
  const int factor = doubled ? 2 : 1;
  return {.octave = doubled ? -1 : 0,
          .width = factor * width,
          .height = factor * height,
          .panorama_from_x = 1.0 / factor,
          .panorama_from_y = 1.0 / factor};
}

/// Half as many rows and columns, to the nearest even number of columns: half a turn is whole.
OctavePlan NextOctave(const OctavePlan& fine) {
  OctavePlan coarse{.octave = fine.octave + 1,
                    .width = 2 * ((fine.width + 2) / 4),
                    .height = (fine.height + 1) / 2};
  coarse.panorama_from_x = fine.panorama_from_x * fine.width / coarse.width;
  coarse.panorama_from_y = fine.panorama_from_y * fine.height / coarse.height;
  return coarse;
}

/// Fills the rows needed on every level, from those that the next octave needs of its first one.
void PlanRows(const ScaleSpacePlan& plan, const OctavePlan* next, OctavePlan& octave) {
  std::array<RowRange, kSiftLevels>& levels = octave.levels;
  for (int l = kSiftLevels - 1; l >= 0; --l) {
    const auto level = static_cast<size_t>(l);
    levels[level] = Grown(octave.detection, kRefinementReach);
    if (l >= 1 && l <= kSiftScales)
      levels[level] = Union(levels[level], Grown(octave.detection, kPatchRadius));
    if (l == kSiftScales && next != nullptr) {
      const RowRange below = next->levels[0];
      const RowHalver halver(octave.height, next->height);
      levels[level] = Union(
          levels[level],
          {halver.FirstSource(below.begin), halver.FirstSource(below.end - 1) + kHalvingTaps});
    }
    if (l + 1 < kSiftLevels)
      levels[level] = Union(levels[level], Grown(levels[level + 1], plan.taps[level].radius));
    levels[level] = Clipped(levels[level], octave.height);
  }
}

}  // namespace

double SigmaOfLevel(const ScaleSpacePlan& plan, double level) {
  return plan.sigma_0_px * std::exp2(level / kSiftScales);
}

ScaleSpacePlan PlanScaleSpace(int width, int height, bool doubled, double first_y, double end_y) {
  ScaleSpacePlan plan{.width = width,
                      .height = height,
                      .doubled = doubled,
                      .sigma_0_px = doubled ? kSigma0_px : kSigma0Full_px};
  plan.base_taps =
      MakeGaussianTaps(BlurBetween(doubled ? 2 * kOwnBlur_px : kOwnBlur_px, plan.sigma_0_px));
  for (int l = 0; l + 1 < kSiftLevels; ++l)
    plan.taps[static_cast<size_t>(l)] =
        MakeGaussianTaps(BlurBetween(SigmaOfLevel(plan, l), SigmaOfLevel(plan, l + 1)));
  for (OctavePlan octave = FirstOctave(width, height, doubled); octave.height >= kSmallestHeight;
       octave = NextOctave(octave)) {
    octave.detection =
        Clipped({static_cast<int>(std::floor(first_y / octave.panorama_from_y - 1.5)),
                 static_cast<int>(std::ceil(end_y / octave.panorama_from_y + 1.5))},
                octave.height);
    plan.octaves.push_back(octave);
  }
  for (size_t i = plan.octaves.size(); i-- > 0;)
    PlanRows(plan, i + 1 < plan.octaves.size() ? &plan.octaves[i + 1] : nullptr, plan.octaves[i]);
  if (!plan.octaves.empty())
    plan.base =
        Clipped(Grown(plan.octaves[0].levels[0], plan.base_taps.radius), plan.octaves[0].height);
  return plan;
}

}  // namespace orbweave::internal
