// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/features/sift/descriptor_weights.h"
#include "core/features/sift/sift_kernels.h"

/// What the kernels of sift_kernels.h do, for lanes of any width. Who includes this defines
/// ORBWEAVE_LANES, the attributes of its functions, and hands over its lanes: types Floats, Ints,
/// Mask and the operations on them, as in sift_kernel_portable.cc.

namespace orbweave::internal {

/// Columns that are blurred down and then across at a time: source rows stay in the first cache.
constexpr int kBlurColumns = 256;

/// Vectors of columns whose sums are in registers together.
template <typename L>
constexpr int kVectorsAtOnce = L::kWidth == 16 ? 2 : 4;

/// sum over i of taps[|i|] row[i], folded: one product for each two rows.
template <typename L, int kRadius>
ORBWEAVE_LANES void BlurDown(
    const float* const* rows, const float* taps, int begin, int end, float* out) {
  constexpr int kUnroll = kVectorsAtOnce<L>;
  constexpr int kStep = kUnroll * static_cast<int>(L::kWidth);
  for (int x = begin; x < end; x += kStep) {
    typename L::Floats sum[kUnroll];
    for (int j = 0; j < kUnroll; ++j) {
      const int at = x + j * static_cast<int>(L::kWidth);
      sum[j] = L::Mul(L::Load(rows[kRadius] + at), L::Set(taps[0]));
    }
#pragma GCC unroll 10
    for (int i = 1; i <= kRadius; ++i) {
      const typename L::Floats tap = L::Set(taps[i]);
#pragma GCC unroll 4
      for (int j = 0; j < kUnroll; ++j) {
        const int at = x + j * static_cast<int>(L::kWidth);
        const typename L::Floats both =
            L::Add(L::Load(rows[kRadius - i] + at), L::Load(rows[kRadius + i] + at));
        sum[j] = L::Add(sum[j], L::Mul(both, tap));
      }
    }
    for (int j = 0; j < kUnroll; ++j)
      L::Store(out + (x - begin) + j * static_cast<int>(L::kWidth), sum[j]);
  }
}

template <typename L, int kRadius>
ORBWEAVE_LANES void BlurAcross(const float* row, const float* taps, int columns, float* out) {
  constexpr int kUnroll = kVectorsAtOnce<L>;
  constexpr int kStep = kUnroll * static_cast<int>(L::kWidth);
  for (int x = 0; x < columns; x += kStep) {
    typename L::Floats sum[kUnroll];
    for (int j = 0; j < kUnroll; ++j) {
      const int at = x + j * static_cast<int>(L::kWidth);
      sum[j] = L::Mul(L::Load(row + at), L::Set(taps[0]));
    }
#pragma GCC unroll 10
    for (int i = 1; i <= kRadius; ++i) {
      const typename L::Floats tap = L::Set(taps[i]);
#pragma GCC unroll 4
      for (int j = 0; j < kUnroll; ++j) {
        const int at = x + j * static_cast<int>(L::kWidth);
        const typename L::Floats both = L::Add(L::Load(row + at - i), L::Load(row + at + i));
        sum[j] = L::Add(sum[j], L::Mul(both, tap));
      }
    }
    for (int j = 0; j < kUnroll; ++j) L::Store(out + x + j * static_cast<int>(L::kWidth), sum[j]);
  }
}

template <typename L, int kRadius>
ORBWEAVE_LANES void BlurRows(const BlurJob& job) {
  alignas(64) float line[kColumnsBefore + kBlurColumns + kMaxBlurRadius + 64];
  for (int begin = 0; begin < job.columns; begin += kBlurColumns) {
    const int end = std::min(begin + kBlurColumns, job.columns);
    for (int r = 0; r < job.num_rows; ++r) {
      // From a whole cache line on: vectors do not lie across two.
      BlurDown<L, kRadius>(job.rows + r, job.taps, begin - kColumnsBefore, end + kRadius, line);
      BlurAcross<L, kRadius>(line + kColumnsBefore, job.taps, end - begin, job.out[r] + begin);
    }
  }
}

/// Of one row and column block: differences of Gaussians, largest and smallest of three neighbours.
struct DogRow {
  alignas(64) std::array<float, kExtremaColumns + 32> dog;
  alignas(64) std::array<float, kExtremaColumns> high;
  alignas(64) std::array<float, kExtremaColumns> low;
};
using DogRows = std::array<DogRow, kSiftDogs>;
constexpr int kDogBefore = 16;  // column 0 of the block in DogRow::dog

template <typename L>
ORBWEAVE_LANES void SubtractLevels(const ExtremaJob& job, int row, DogRows& out) {
  const int columns = job.end_column - job.first_column;
  const int width = static_cast<int>(L::kWidth);
  for (int d = 0; d < kSiftDogs; ++d) {
    const float* const fine = job.rows[static_cast<size_t>(d)][row] + job.first_column;
    const float* const coarse = job.rows[static_cast<size_t>(d) + 1][row] + job.first_column;
    DogRow& to = out[static_cast<size_t>(d)];
    float* const dog = to.dog.data() + kDogBefore;
    for (int x = -width; x < columns + width; x += width)
      L::Store(dog + x, L::Sub(L::Load(coarse + x), L::Load(fine + x)));
    for (int x = 0; x < columns; x += width) {
      const typename L::Floats left = L::Load(dog + x - 1);
      const typename L::Floats middle = L::Load(dog + x);
      const typename L::Floats right = L::Load(dog + x + 1);
      L::Store(to.high.data() + x, L::Max(L::Max(left, right), middle));
      L::Store(to.low.data() + x, L::Min(L::Min(left, right), middle));
    }
  }
}

template <typename L>
ORBWEAVE_LANES size_t
HitsOfRow(const ExtremaJob& job, int row, const DogRows* const* rows, SiftHit* hits) {
  size_t count = 0;
  const int columns = job.end_column - job.first_column;
  const typename L::Floats above = L::Set(job.threshold);
  const typename L::Floats below = L::Set(-job.threshold);
  for (int x = 0; x < columns; x += static_cast<int>(L::kWidth)) {
    typename L::Floats high[kSiftDogs];
    typename L::Floats low[kSiftDogs];
    for (size_t d = 0; d < kSiftDogs; ++d) {
      const DogRow& a = (*rows[0])[d];
      const DogRow& b = (*rows[1])[d];
      const DogRow& c = (*rows[2])[d];
      high[d] = L::Max(L::Max(L::Load(&a.high[static_cast<size_t>(x)]),
                              L::Load(&b.high[static_cast<size_t>(x)])),
                       L::Load(&c.high[static_cast<size_t>(x)]));
      low[d] = L::Min(
          L::Min(L::Load(&a.low[static_cast<size_t>(x)]), L::Load(&b.low[static_cast<size_t>(x)])),
          L::Load(&c.low[static_cast<size_t>(x)]));
    }
    for (size_t s = 1; s <= kSiftScales; ++s) {
      const typename L::Floats value =
          L::Load(&(*rows[1])[s].dog[static_cast<size_t>(x + kDogBefore)]);
      const typename L::Floats top = L::Max(L::Max(high[s - 1], high[s]), high[s + 1]);
      const typename L::Floats bottom = L::Min(L::Min(low[s - 1], low[s]), low[s + 1]);
      uint32_t bits = L::Bits(L::Or(L::And(L::Less(above, value), L::LessEqual(top, value)),
                                    L::And(L::Less(value, below), L::LessEqual(value, bottom))));
      for (; bits != 0; bits &= bits - 1) {
        const int column = x + __builtin_ctz(bits);
        if (column < columns)
          hits[count++] = {job.first_column + column, row, static_cast<int32_t>(s)};
      }
    }
  }
  return count;
}

template <typename L>
ORBWEAVE_LANES size_t FindExtremaOf(const ExtremaJob& job) {
  DogRows rows[3];
  SubtractLevels<L>(job, 0, rows[0]);
  SubtractLevels<L>(job, 1, rows[1]);
  size_t count = 0;
  for (int row = 0; row < job.num_rows; ++row) {
    SubtractLevels<L>(job, row + 2, rows[(row + 2) % 3]);
    const DogRows* const three[3] = {&rows[row % 3], &rows[(row + 1) % 3], &rows[(row + 2) % 3]};
    count += HitsOfRow<L>(job, row, three, job.hits + count);
  }
  return count;
}

/// Direction of (x, y) in eighths of a turn, [0, 8]: arctan on [0, 1] to 1e-5 rad by Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 4.4.49, times 4 / pi, and symmetries.
template <typename L>
ORBWEAVE_LANES typename L::Floats EighthsOf(typename L::Floats y, typename L::Floats x) {
  const typename L::Floats ax = L::Abs(x);
  const typename L::Floats ay = L::Abs(y);
  const typename L::Floats small = L::Min(ax, ay);
  const typename L::Floats large = L::Max(ax, ay);
  const typename L::Floats q = L::Div(small, L::Add(large, L::Set(1e-20F)));
  const typename L::Floats q2 = L::Mul(q, q);
  typename L::Floats a = L::Mul(q2, L::Set(0.0265282F));
  a = L::Mul(q2, L::Add(a, L::Set(-0.1083958F)));
  a = L::Mul(q2, L::Add(a, L::Set(0.2293627F)));
  a = L::Mul(q2, L::Add(a, L::Set(-0.4205504F)));
  a = L::Mul(q, L::Add(a, L::Set(1.2730689F)));
  a = L::Select(L::Less(ax, ay), L::Sub(L::Set(2.0F), a), a);
  a = L::Select(L::Less(x, L::Set(0.0F)), L::Sub(L::Set(4.0F), a), a);
  return L::Select(L::Less(y, L::Set(0.0F)), L::Sub(L::Set(8.0F), a), a);
}

template <typename L>
ORBWEAVE_LANES void AddOrientations(const OrientationJob& job) {
  constexpr int kMost = 2 * kMaxOrientationRadius + 1 + 16;
  alignas(64) float weights[kMost] = {};
  alignas(64) float votes[kMost];
  alignas(64) int32_t bins[kMost];
  const int side = 2 * job.radius + 1;
  for (int i = 0; i < side; ++i) weights[i] = job.weights[std::abs(i - job.radius)];
  for (int j = -job.radius; j <= job.radius; ++j) {
    const float* const row =
        job.patch.pixels + (job.row + j) * job.patch.stride + job.column - job.radius;
    for (int i = 0; i < side; i += static_cast<int>(L::kWidth)) {
      const typename L::Floats gx = L::Sub(L::Load(row + i + 1), L::Load(row + i - 1));
      const typename L::Floats gy =
          L::Sub(L::Load(row + i + job.patch.stride), L::Load(row + i - job.patch.stride));
      const typename L::Floats size = L::Sqrt(L::Add(L::Mul(gx, gx), L::Mul(gy, gy)));
      const typename L::Floats weight =
          L::Mul(L::Load(weights + i), L::Set(job.weights[std::abs(j)]));
      L::Store(votes + i, L::Mul(size, weight));
      const typename L::Floats bin =
          L::Add(L::Mul(EighthsOf<L>(gy, gx), L::Set(kOrientationBins / 8.0F)), L::Set(0.5F));
      L::StoreInts(bins + i, L::Truncate(bin));
    }
    for (int i = 0; i < side; ++i)
      job.histogram[bins[i] < kOrientationBins ? bins[i] : bins[i] - kOrientationBins] += votes[i];
  }
}

constexpr int kSampleColumns = kDescriptorGrid + 2;
using SampleRow = std::array<float, 32>;

/// Bilinear samples of a row of the grid.
template <typename L>
ORBWEAVE_LANES void SampleRowOf(const DescriptorJob& job, int j, SampleRow& out) {
  constexpr int kLast = kSampleColumns - static_cast<int>(L::kWidth);
  const float v = static_cast<float>(j) - 8.5F;
  const typename L::Floats from_x = L::Set(job.x - v * job.sine);
  const typename L::Floats from_y = L::Set(job.y + v * job.cosine);
  for (int first = 0;; first = std::min(first + static_cast<int>(L::kWidth), kLast)) {
    const typename L::Floats u = L::Add(L::Iota(), L::Set(static_cast<float>(first) - 8.5F));
    const typename L::Floats x = L::Add(from_x, L::Mul(u, L::Set(job.cosine)));
    const typename L::Floats y = L::Add(from_y, L::Mul(u, L::Set(job.sine)));
    const typename L::Ints column = L::Truncate(x);  // within the patch, so not negative
    const typename L::Ints row = L::Truncate(y);
    const typename L::Floats fx = L::Sub(x, L::ToFloats(column));
    const typename L::Floats fy = L::Sub(y, L::ToFloats(row));
    const typename L::Ints index = L::AddInts(L::MulInts(row, L::SetInt(job.patch.stride)), column);
    const float* const origin = job.patch.pixels;
    const typename L::Floats a = L::Gather(origin, index);
    const typename L::Floats b = L::Gather(origin + 1, index);
    const typename L::Floats c = L::Gather(origin + job.patch.stride, index);
    const typename L::Floats d = L::Gather(origin + job.patch.stride + 1, index);
    const typename L::Floats upper = L::Add(a, L::Mul(fx, L::Sub(b, a)));
    const typename L::Floats lower = L::Add(c, L::Mul(fx, L::Sub(d, c)));
    L::Store(out.data() + first, L::Add(upper, L::Mul(fy, L::Sub(lower, upper))));
    if (first == kLast) return;
  }
}

/// Votes of a row's gradients for eight directions, shared between the two nearest.
struct VoteRow {
  alignas(64) float votes[8][kDescriptorGrid];
};

template <typename L>
ORBWEAVE_LANES void VotesOfRow(const SampleRow* rows, VoteRow& out) {
  for (int i = 0; i < kDescriptorGrid; i += static_cast<int>(L::kWidth)) {
    const typename L::Floats gx =
        L::Sub(L::Load(rows[1].data() + i + 2), L::Load(rows[1].data() + i));
    const typename L::Floats gy =
        L::Sub(L::Load(rows[2].data() + i + 1), L::Load(rows[0].data() + i + 1));
    const typename L::Floats size = L::Sqrt(L::Add(L::Mul(gx, gx), L::Mul(gy, gy)));
    const typename L::Floats angle = EighthsOf<L>(gy, gx);
    const typename L::Floats one = L::Set(1.0F);
    const typename L::Floats none = L::Set(0.0F);
    for (int o = 0; o < 8; ++o) {
      typename L::Floats apart = L::Abs(L::Sub(angle, L::Set(static_cast<float>(o))));
      if (o == 0) apart = L::Min(apart, L::Sub(L::Set(8.0F), angle));
      L::Store(out.votes[o] + i, L::Mul(size, L::Max(L::Sub(one, apart), none)));
    }
  }
}

/// Sum of 16 lanes: halves added until one is left.
ORBWEAVE_LANES float SumOfSixteen(float* lanes) {
  for (int half = 8; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

template <typename L>
ORBWEAVE_LANES void SumDescriptor(const DescriptorJob& job) {
  const DescriptorWeights& weights = WeightsOfDescriptor();
  SampleRow samples[kSampleColumns];
  for (int j = 0; j < kSampleColumns; ++j) SampleRowOf<L>(job, j, samples[j]);
  alignas(64) float sums[4][8][kDescriptorGrid] = {};
  VoteRow row;
  for (int j = 0; j < kDescriptorGrid; ++j) {
    VotesOfRow<L>(samples + j, row);
    for (int cy = 0; cy < 4; ++cy) {
      const float weight = weights.of_cell[cy][j];
      if (weight <= 0.0F) continue;
      for (int o = 0; o < 8; ++o) {
        for (int i = 0; i < kDescriptorGrid; i += static_cast<int>(L::kWidth)) {
          const typename L::Floats vote = L::Mul(L::Load(row.votes[o] + i), L::Set(weight));
          L::Store(&sums[cy][o][i], L::Add(L::Load(&sums[cy][o][i]), vote));
        }
      }
    }
  }
  for (int cell = 0; cell < 16; ++cell) {
    for (int o = 0; o < 8; ++o) {
      alignas(64) float lanes[kDescriptorGrid];
      for (int i = 0; i < kDescriptorGrid; i += static_cast<int>(L::kWidth)) {
        L::Store(lanes + i,
                 L::Mul(L::Load(&sums[cell / 4][o][i]), L::Load(&weights.of_cell[cell % 4][i])));
      }
      job.histogram[cell * 8 + o] = SumOfSixteen(lanes);
    }
  }
}

template <typename L>
ORBWEAVE_LANES void Blur(const BlurJob& job) {
  switch (job.radius) {
    case 4:
      return BlurRows<L, 4>(job);
    case 5:
      return BlurRows<L, 5>(job);
    case 6:
      return BlurRows<L, 6>(job);
    case 8:
      return BlurRows<L, 8>(job);
    default:
      return BlurRows<L, 10>(job);
  }
}

}  // namespace orbweave::internal
