// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace orbweave::internal {

constexpr int kHalvingTaps = 4;

/// Rows (or columns) of about half as many, by Catmull and Rom's cubic through four neighbours.
/// Where the number halves exactly that is (-1, 9, 9, -1) / 16, which adds no variance, and the new
/// grid is as symmetric about seam and poles as the old one; otherwise the grid is stretched, so
/// that it ends at the same place.
class RowHalver {
 public:
  RowHalver(int fine, int coarse) : fine_(fine), coarse_(coarse) {}

  [[nodiscard]] bool IsExact() const { return 2 * coarse_ == fine_; }
  /// The first of kHalvingTaps neighbouring rows from which `row` of the coarse grid is made; may
  /// lie beyond the grid.
  [[nodiscard]] int FirstSource(int row) const;
  [[nodiscard]] std::array<float, kHalvingTaps> Weights(int row) const;

 private:
  /// Position of the middle of a coarse row, from the middle of the first fine one.
  [[nodiscard]] double Position(int row) const { return (row + 0.5) * fine_ / coarse_ - 0.5; }

  int fine_ = 0;
  int coarse_ = 0;
};

/// Makes the rows of a coarser grid.
class ColumnHalver {
 public:
  ColumnHalver(int fine_width, int coarse_width);

  /// One coarse row from kHalvingTaps fine rows that continue beyond their ends (kColumnsBefore).
  void Halve(const std::array<const float*, kHalvingTaps>& rows,
             const std::array<float, kHalvingTaps>& weights,
             float* out);

 private:
  int fine_width_ = 0;
  int coarse_width_ = 0;
  RowHalver halver_;
  std::vector<float> line_{};
};

}  // namespace orbweave::internal
