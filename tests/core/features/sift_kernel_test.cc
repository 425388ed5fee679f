// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/sift_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/features/sift/gaussian_taps.h"

namespace orbweave::internal {
namespace {

/// Rows of noise with room on both sides.
class Rows {
 public:
  Rows(int count, int columns, uint64_t seed) : stride_(columns + kColumnsBefore + kColumnsBehind) {
    Random random(seed);
    for (int i = 0; i < count * stride_; ++i)
      storage_.push_back(static_cast<float>(random.Uniform(0.0, 255.0)));
    for (int i = 0; i < count; ++i) rows_.push_back(storage_.data() + i * stride_ + kColumnsBefore);
  }
  [[nodiscard]] const float* const* rows() const { return rows_.data(); }

 private:
  int stride_ = 0;
  std::vector<float> storage_{};
  std::vector<const float*> rows_{};
};

std::vector<std::vector<float>> Blurred(const SiftKernels& kernels,
                                        const Rows& rows,
                                        int num_rows,
                                        int columns,
                                        const GaussianTaps& taps) {
  std::vector<std::vector<float>> storage(
      static_cast<size_t>(num_rows),
      std::vector<float>(static_cast<size_t>(columns + kColumnsBehind)));
  std::vector<float*> out;
  for (auto& row : storage) out.push_back(row.data());
  kernels.blur({.rows = rows.rows(),
                .out = out.data(),
                .num_rows = num_rows,
                .columns = columns,
                .taps = taps.taps.data(),
                .radius = taps.radius});
  for (auto& row : storage) row.resize(static_cast<size_t>(columns));
  return storage;
}

std::vector<std::array<int, 3>> Extrema(const SiftKernels& kernels,
                                        const std::array<const float* const*, kSiftLevels>& levels,
                                        int num_rows,
                                        int columns,
                                        float threshold) {
  std::vector<SiftHit> hits(static_cast<size_t>(kSiftScales * num_rows * columns));
  hits.resize(kernels.find_extrema({.rows = levels,
                                    .num_rows = num_rows,
                                    .first_column = 0,
                                    .end_column = columns,
                                    .threshold = threshold,
                                    .hits = hits.data()}));
  std::vector<std::array<int, 3>> found;
  for (const SiftHit& hit : hits) found.push_back({hit.scale, hit.row, hit.column});
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SiftKernels, BlurAsTheDefinitionSays) {
  const GaussianTaps taps = MakeGaussianTaps(1.6);
  const Rows rows(3 + 2 * taps.radius, 70, 1);
  const auto blurred = Blurred(SiftKernelsOf(SiftKernel::kPortable), rows, 3, 70, taps);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 70; ++x) {
      double sum = 0.0;
      for (int j = -taps.radius; j <= taps.radius; ++j) {
        for (int i = -taps.radius; i <= taps.radius; ++i) {
          sum += double{taps.taps[static_cast<size_t>(std::abs(i))]} *
                 double{taps.taps[static_cast<size_t>(std::abs(j))]} *
                 rows.rows()[y + j + taps.radius][x + i];
        }
      }
      EXPECT_NEAR(blurred[static_cast<size_t>(y)][static_cast<size_t>(x)], sum, 1e-3);
    }
  }
}

TEST(SiftKernels, BlurToTheSameBits) {
  for (const double sigma_px : {1.2, 1.5, 1.9, 2.4, 3.1}) {
    const GaussianTaps taps = MakeGaussianTaps(sigma_px);
    for (const int columns : {1, 37, 64, 255, 257, 515}) {
      const Rows rows(5 + 2 * taps.radius, columns, 2);
      const auto expected = Blurred(SiftKernelsOf(SiftKernel::kPortable), rows, 5, columns, taps);
      for (const SiftKernel kernel : AvailableSiftKernels())
        EXPECT_EQ(Blurred(SiftKernelsOf(kernel), rows, 5, columns, taps), expected)
            << static_cast<int>(kernel) << " " << columns;
    }
  }
}

TEST(SiftKernels, FindWhatIsExtremeAmongTwentySixNeighbours) {
  constexpr int kRows = 6;
  constexpr int kColumns = 101;
  constexpr float kThreshold = 100.0F;
  std::vector<Rows> levels;
  std::array<const float* const*, kSiftLevels> job{};
  for (uint64_t l = 0; l < kSiftLevels; ++l) levels.emplace_back(kRows + 2, kColumns, 10 + l);
  for (size_t l = 0; l < kSiftLevels; ++l) job[l] = levels[l].rows();
  const auto dog = [&](int scale, int row, int column) {
    const auto s = static_cast<size_t>(scale);
    return job[s + 1][row + 1][column] - job[s][row + 1][column];
  };
  std::vector<std::array<int, 3>> expected;
  for (int s = 1; s <= kSiftScales; ++s) {
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const float value = dog(s, y, x);
        bool is_extreme = std::abs(value) > kThreshold;
        for (int k = 0; k < 27; ++k) {
          const float other = dog(s + k / 9 - 1, y + k / 3 % 3 - 1, x + k % 3 - 1);
          is_extreme = is_extreme && (value > 0.0F ? value >= other : value <= other);
        }
        if (is_extreme) expected.push_back({s, y, x});
      }
    }
  }
  ASSERT_GT(expected.size(), 20U);
  for (const SiftKernel kernel : AvailableSiftKernels())
    EXPECT_EQ(Extrema(SiftKernelsOf(kernel), job, kRows, kColumns, kThreshold), expected)
        << static_cast<int>(kernel);
}

TEST(SiftKernels, DescribeToTheSameBits) {
  constexpr int kSide = 87;
  Random random(3);
  std::vector<float> pixels;
  for (int i = 0; i < kSide * kSide + 64; ++i)
    pixels.push_back(static_cast<float>(random.Uniform(0.0, 255.0)));
  for (int trial = 0; trial < 20; ++trial) {
    const auto step = static_cast<float>(random.Uniform(1.5, 3.3));
    const auto angle = static_cast<float>(random.Uniform(0.0, 6.28));
    DescriptorJob describe{.patch = {pixels.data(), kSide},
                           .x = static_cast<float>(random.Uniform(42.5, 43.5)),
                           .y = static_cast<float>(random.Uniform(42.5, 43.5)),
                           .cosine = step * std::cos(angle),
                           .sine = step * std::sin(angle)};
    std::vector<float> weights;
    for (int i = 0; i <= kMaxOrientationRadius; ++i)
      weights.push_back(static_cast<float>(random.Uniform()));
    OrientationJob orient{.patch = {pixels.data(), kSide},
                          .column = 43,
                          .row = 43,
                          .radius = 8 + trial % 9,
                          .weights = weights.data()};
    const auto run = [&](SiftKernel kernel) {
      std::vector<float> result(128 + kOrientationBins);
      describe.histogram = result.data();
      orient.histogram = result.data() + 128;
      SiftKernelsOf(kernel).sum_descriptor(describe);
      SiftKernelsOf(kernel).add_orientations(orient);
      return result;
    };
    const std::vector<float> expected = run(SiftKernel::kPortable);
    for (const SiftKernel kernel : AvailableSiftKernels())
      EXPECT_EQ(run(kernel), expected) << static_cast<int>(kernel);
  }
}

/// A ramp of greys has one gradient everywhere.
TEST(SiftKernels, FindTheDirectionOfARamp) {
  constexpr int kSide = 61;
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    std::vector<float> pixels(kSide * kSide + 64);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x)
        pixels[static_cast<size_t>(y * kSide + x)] =
            static_cast<float>(500.0 + x * std::cos(angle) + y * std::sin(angle));
    }
    const std::vector<float> weights(10, 1.0F);
    std::vector<float> bins(kOrientationBins);
    SiftKernelsOf(AvailableSiftKernels().back())
        .add_orientations({.patch = {pixels.data(), kSide},
                           .column = 30,
                           .row = 30,
                           .radius = 9,
                           .weights = weights.data(),
                           .histogram = bins.data()});
    EXPECT_EQ(std::max_element(bins.begin(), bins.end()) - bins.begin(), degrees / 10) << degrees;
    std::vector<float> histogram(128);
    SiftKernelsOf(AvailableSiftKernels().back())
        .sum_descriptor({.patch = {pixels.data(), kSide},
                         .x = 30.0F,
                         .y = 30.0F,
                         .cosine = 1.5F * static_cast<float>(std::cos(angle)),
                         .sine = 1.5F * static_cast<float>(std::sin(angle)),
                         .histogram = histogram.data()});
    for (size_t cell = 0; cell < 16; ++cell) {
      for (size_t o = 1; o < 8; ++o)  // all in the keypoint's own direction
        EXPECT_LT(histogram[8 * cell + o], 0.01F * histogram[8 * cell]) << degrees;
    }
  }
}

}  // namespace
}  // namespace orbweave::internal
