// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/describe_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/features/sift/descriptor_weights.h"
#include "core/features/sift/octave_plan.h"

namespace orbweave::internal {
namespace {

constexpr float kOrientationSigmas = 1.5F;
constexpr float kOrientationReach = 3.0F;  // times that
constexpr float kPeakShare = 0.8F;
constexpr float kCellSigmas = 3.0F;
constexpr float kLargestShare = 0.2F;

using OrientationHistogram = std::array<float, kOrientationBins>;

/// Circular convolution with (1, 4, 6, 4, 1) / 16.
OrientationHistogram Smoothed(const OrientationHistogram& h) {
  OrientationHistogram smooth;
  constexpr size_t n = kOrientationBins;
  for (size_t i = 0; i < n; ++i) {
    smooth[i] = (h[(i + n - 2) % n] + h[(i + 2) % n]) / 16.0F +
                (h[(i + n - 1) % n] + h[(i + 1) % n]) / 4.0F + h[i] * 0.375F;
  }
  return smooth;
}

/// Peaks of the histogram, by a parabola through three bins; radians.
std::vector<float> PeaksOf(const OrientationHistogram& h) {
  const float least = kPeakShare * *std::max_element(h.begin(), h.end());
  std::vector<float> peaks;
  constexpr size_t n = kOrientationBins;
  for (size_t i = 0; i < n; ++i) {
    const float left = h[(i + n - 1) % n];
    const float right = h[(i + 1) % n];
    if (h[i] <= left || h[i] <= right || h[i] < least) continue;
    float bin = static_cast<float>(i) + 0.5F * (left - right) / (left - 2.0F * h[i] + right);
    if (bin < 0.0F) bin += static_cast<float>(n);
    if (bin >= static_cast<float>(n)) bin -= static_cast<float>(n);
    peaks.push_back(bin * (2.0F * std::numbers::pi_v<float> / static_cast<float>(n)));
  }
  return peaks;
}

std::vector<float> OrientationsOf(const SiftKernels& kernels,
                                  const SiftPatch& patch,
                                  int middle,
                                  float sigma) {
  const float window = kOrientationSigmas * sigma;
  const int radius =
      std::min(kMaxOrientationRadius, static_cast<int>(std::lround(kOrientationReach * window)));
  std::array<float, kMaxOrientationRadius + 1> weights{};
  for (int i = 0; i <= radius; ++i)
    // In double precision: rounded, it does not depend on the machine's library.
    weights[static_cast<size_t>(i)] =
        static_cast<float>(std::exp(-0.5 * i * i / (double{window} * window)));
  OrientationHistogram histogram{};
  kernels.add_orientations({.patch = patch,
                            .column = middle,
                            .row = middle,
                            .radius = radius,
                            .weights = weights.data(),
                            .histogram = histogram.data()});
  return PeaksOf(Smoothed(histogram));
}

void WriteRootSift(std::array<float, kDescriptorSize>& h, uint8_t* out) {
  float squares = 0.0F;
  for (const float value : h) squares += value * value;
  const float limit = kLargestShare * std::sqrt(squares);
  float sum = 0.0F;
  for (float& value : h) {
    value = std::min(value, limit);
    sum += value;
  }
  const float scale = sum > 0.0F ? 512.0F * 512.0F / sum : 0.0F;
  for (size_t k = 0; k < h.size(); ++k)
    out[k] = static_cast<uint8_t>(std::min(255.0F, std::sqrt(h[k] * scale) + 0.5F));
}

}  // namespace

PositionDescriber::PositionDescriber(const SiftKernels& kernels)
    : kernels_(kernels),
      // The kernels' vectors reach over the end of the last row.
      pixels_(static_cast<size_t>((2 * kPatchRadius + 1) * (2 * kPatchRadius + 1) + 64)) {}

void PositionDescriber::Describe(const SiftPosition& position,
                                 float sigma_px,
                                 uint32_t number,
                                 const RowRing& rows,
                                 std::vector<DescribedPosition>& described) {
  const float step = kCellSigmas * sigma_px * kDescriptorSpanCells / kDescriptorGrid;
  const float reach = 0.5F * std::numbers::sqrt2_v<float> * (kDescriptorGrid + 1) * step;
  const int radius = std::min(kPatchRadius, static_cast<int>(reach) + 2);
  rows.ReadSquare(position.column, position.row, radius, pixels_.data());
  const SiftPatch patch{pixels_.data(), 2 * radius + 1};
  for (const float angle : OrientationsOf(kernels_, patch, radius, sigma_px)) {
    std::array<float, kDescriptorSize> histogram{};
    kernels_.sum_descriptor({.patch = patch,
                             .x = static_cast<float>(radius) + position.dx,
                             .y = static_cast<float>(radius) + position.dy,
                             .cosine = static_cast<float>(std::cos(double{angle})) * step,
                             .sine = static_cast<float>(std::sin(double{angle})) * step,
                             .histogram = histogram.data()});
    DescribedPosition& last = described.emplace_back();
    last.position = number;
    last.orientation_rad = angle;
    WriteRootSift(histogram, last.descriptor.data());
  }
}

}  // namespace orbweave::internal
