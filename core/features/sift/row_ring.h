// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/features/sift/sift_kernels.h"

namespace orbweave::internal {

/// Rows beyond a pole that a window of rows holds beside those of the grid.
constexpr int kRowsBeyondPole = kMaxBlurRadius;

/// The latest rows of a grid on the sphere. Every finished row continues across the seam on both
/// sides, and rows -kRowsBeyondPole ... -1 and height ... are those across the poles.
class RowRing {
 public:
  RowRing(int width, int height, int capacity);

  [[nodiscard]] int width() const { return width_; }
  /// Row `y`, from its column 0: one of the latest `capacity`.
  [[nodiscard]] float* Row(int y) {
    return storage_.data() + first_ + static_cast<size_t>((y + capacity_) % capacity_) * stride_;
  }
  [[nodiscard]] const float* Row(int y) const { return const_cast<RowRing*>(this)->Row(y); }

  /// Whether rows [first, last] are among the latest.
  [[nodiscard]] bool Holds(int first, int last) const {
    return first > newest_ - capacity_ && last <= newest_;
  }

  /// The square of 2 radius + 1 pixels about a pixel, as if the sphere were flat there: across the
  /// seam and the poles. Its rows must be among the latest. Written to `pixels`, row after row.
  void ReadSquare(int column, int row, int radius, float* pixels) const;

  /// To be called in the order of rows, once the columns of row `y` are written.
  void Finish(int y);

 private:
  void WrapColumns(float* row) const;
  void CopyAcrossPole(int from, int to);

  int width_ = 0;
  int height_ = 0;
  int capacity_ = 0;
  int newest_ = std::numeric_limits<int>::min() / 2;
  size_t stride_ = 0;
  size_t first_ = 0;  ///< column 0 of the first row: at the beginning of a cache line, as all are
  std::vector<float> storage_{};
};

}  // namespace orbweave::internal
