// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace orbweave {

/// Sums over squares of cells of one face, cut at its edges.
class SquareSums {
 public:
  explicit SquareSums(int cells)
      : cells_(cells), sums_(static_cast<size_t>((cells + 1) * (cells + 1))) {}

  template <typename ValueOf>
  void Fill(ValueOf&& value_of) {
    for (int row = 0; row < cells_; ++row) {
      double line = 0.0;
      for (int column = 0; column < cells_; ++column) {
        line += value_of(row * cells_ + column);
        sums_[At(row + 1, column + 1)] = sums_[At(row, column + 1)] + line;
      }
    }
  }

  [[nodiscard]] float Around(int row, int column, int reach) const {
    const int top = std::max(0, row - reach);
    const int left = std::max(0, column - reach);
    const int bottom = std::min(cells_, row + reach + 1);
    const int right = std::min(cells_, column + reach + 1);
    return static_cast<float>(sums_[At(bottom, right)] - sums_[At(top, right)] -
                              sums_[At(bottom, left)] + sums_[At(top, left)]);
  }

 private:
  [[nodiscard]] size_t At(int row, int column) const {
    return static_cast<size_t>(row * (cells_ + 1) + column);
  }

  int cells_;
  std::vector<double> sums_;
};

}  // namespace orbweave
