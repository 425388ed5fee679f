// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/row_ring.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/base/status.h"
#include "core/features/row_across_poles.h"

namespace orbweave::internal {
namespace {

/// Columns of the other side of the seam that are read behind the last one.
constexpr int kWrappedBehind = 32;
constexpr size_t kCacheLineFloats = 16;
constexpr size_t kPageFloats = 1024;

/// Whole cache lines, and no multiple of a page: rows above each other do not meet in the cache.
size_t StrideOf(int width) {
  const auto floats = static_cast<size_t>(kColumnsBefore + width + kColumnsBehind);
  const size_t stride = (floats + kCacheLineFloats - 1) / kCacheLineFloats * kCacheLineFloats;
  return stride % kPageFloats == 0 ? stride + kCacheLineFloats : stride;
}

void Copy(const float* from, int count, float* to) {
  std::memcpy(to, from, static_cast<size_t>(count) * sizeof(float));
}

}  // namespace

RowRing::RowRing(int width, int height, int capacity)
    : width_(width),
      height_(height),
      capacity_(capacity),
      stride_(StrideOf(width)),
      storage_(stride_ * static_cast<size_t>(capacity) + 2 * kCacheLineFloats) {
  const auto address = reinterpret_cast<uintptr_t>(storage_.data()) / sizeof(float);
  const size_t before = address % kCacheLineFloats;
  first_ = kColumnsBefore + (kCacheLineFloats - before) % kCacheLineFloats;
}

void RowRing::Finish(int y) {
  newest_ = y + 1 < height_ ? y : height_ - 1 + std::min(kRowsBeyondPole, height_);
  WrapColumns(Row(y));
  if (y < kRowsBeyondPole) CopyAcrossPole(y, -1 - y);
  if (y + 1 < height_) return;
  for (int j = 0; j < std::min(kRowsBeyondPole, height_); ++j)
    CopyAcrossPole(height_ - 1 - j, height_ + j);
}

void RowRing::ReadSquare(int column, int row, int radius, float* pixels) const {
  ORBWEAVE_CHECK(Holds(std::max(0, row - radius), std::min(height_ - 1, row + radius)));
  const int side = 2 * radius + 1;
  for (int j = -radius; j <= radius; ++j, pixels += side) {
    const SourceRow source = RowAcrossPoles(row + j, height_);
    const float* const from = Row(source.row);
    int x = Modulo(column - radius + (source.turned ? width_ / 2 : 0), width_);
    for (int done = 0; done < side; x = 0) {
      const int run = std::min(side - done, width_ - x);
      Copy(from + x, run, pixels + done);
      done += run;
    }
  }
}

void RowRing::WrapColumns(float* row) const {
  for (int x = 0; x < kWrappedBehind; x += width_)
    Copy(row, std::min(width_, kWrappedBehind - x), row + width_ + x);
  for (int x = 0; x < kColumnsBefore; x += width_) {
    const int count = std::min(width_, kColumnsBefore - x);
    Copy(row + width_ - count, count, row - x - count);
  }
}

void RowRing::CopyAcrossPole(int from, int to) {
  const int half = width_ / 2;
  Copy(Row(from) + half, width_ - half, Row(to));
  Copy(Row(from), half, Row(to) + width_ - half);
  WrapColumns(Row(to));
}

}  // namespace orbweave::internal
