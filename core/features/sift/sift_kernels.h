// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The inner loops of the streaming SIFT. Lanes are pixels (or samples of one row), no sum crosses
/// them but in a fixed order, products and sums are rounded one by one: the same bits from every
/// kernel.

namespace orbweave::internal {

constexpr int kSiftScales = 3;                ///< scales per octave that extrema are looked for in
constexpr int kSiftLevels = kSiftScales + 3;  ///< Gaussians per octave
constexpr int kSiftDogs = kSiftLevels - 1;

/// Readable floats before the first and behind the last column of every row.
constexpr int kColumnsBefore = 16;
constexpr int kColumnsBehind = 96;

/// Radii of Gaussians beyond this are not provided for.
constexpr int kMaxBlurRadius = 10;

/// Rows convolved with taps[|i|], i = -radius ... radius, down and across: `rows` are
/// num_rows + 2 radius rows, `out` num_rows, all from column 0; columns [0, columns) are written,
/// and up to kColumnsBehind of no meaning behind them.
struct BlurJob {
  const float* const* rows = nullptr;
  float* const* out = nullptr;
  int num_rows = 0;
  int columns = 0;
  const float* taps = nullptr;
  int radius = 0;
};

/// An extremum of the differences of Gaussians among its 26 neighbours, ties included.
struct SiftHit {
  int32_t column = 0;
  int32_t row = 0;    ///< of the job
  int32_t scale = 0;  ///< 1 ... kSiftScales
};

/// Rows 0 ... num_rows - 1 of every level, with a row more on both sides: rows[level][1 + row].
struct ExtremaJob {
  std::array<const float* const*, kSiftLevels> rows{};
  int num_rows = 0;
  int first_column = 0;
  int end_column = 0;  ///< at most kExtremaColumns further
  float threshold = 0.0F;
  SiftHit* hits = nullptr;  ///< room for kSiftScales a pixel
};
constexpr int kExtremaColumns = 256;
constexpr int kExtremaRows = 16;

/// A piece of a level about a keypoint; positions count from the middle of its first pixel.
struct SiftPatch {
  const float* pixels = nullptr;
  int stride = 0;
};

constexpr int kOrientationBins = 36;
/// Gradients of the pixels at most `radius` rows and columns from a pixel, by their direction.
struct OrientationJob {
  SiftPatch patch{};
  int column = 0;
  int row = 0;
  int radius = 0;
  const float* weights = nullptr;  ///< of a row or column 0 ... radius away
  float* histogram = nullptr;      ///< kOrientationBins, added to; bin k is about 2 pi k / bins
};
constexpr int kMaxOrientationRadius = 20;

/// Samples of a descriptor: 16 x 16 in the keypoint's frame, for gradients 18 x 18.
constexpr int kDescriptorGrid = 16;
struct DescriptorJob {
  SiftPatch patch{};
  float x = 0.0F;  ///< of the keypoint, from the middle of the patch
  float y = 0.0F;
  float cosine = 1.0F;  ///< of the orientation, times the step between samples
  float sine = 0.0F;
  float* histogram = nullptr;  ///< 4 x 4 x 8
};

struct SiftKernels {
  void (*blur)(const BlurJob&) = nullptr;
  size_t (*find_extrema)(const ExtremaJob&) = nullptr;
  void (*add_orientations)(const OrientationJob&) = nullptr;
  void (*sum_descriptor)(const DescriptorJob&) = nullptr;
};

const SiftKernels& SiftKernelsPortable();
#if defined(__x86_64__)
const SiftKernels& SiftKernelsAvx2();
const SiftKernels& SiftKernelsAvx512();
#endif

}  // namespace orbweave::internal
