// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace orbweave {

using Block6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Rows i <= column j of a block in the upper triangle.
struct BlockIndex {
  uint32_t column = 0;
  uint32_t row = 0;
  friend auto operator<=>(const BlockIndex&, const BlockIndex&) = default;
};

/// Upper triangle of a symmetric sparse matrix of 6x6 blocks, by block column, rows ascending: the
/// diagonal block is the last of its column. Every diagonal block exists.
struct SymmetricBlockMatrix {
  uint32_t num_blocks = 0;
  std::vector<uint32_t> column_start{};  ///< num_blocks + 1
  std::vector<uint32_t> rows{};
  std::vector<Block6> values{};

  [[nodiscard]] Block6& Diagonal(uint32_t block) { return values[column_start[block + 1] - 1]; }
  [[nodiscard]] const Block6& Diagonal(uint32_t block) const {
    return values[column_start[block + 1] - 1];
  }
  /// Position of an existing block.
  [[nodiscard]] uint32_t Find(BlockIndex index) const {
    const auto begin = rows.begin() + column_start[index.column];
    const auto end = rows.begin() + column_start[index.column + 1];
    return static_cast<uint32_t>(std::lower_bound(begin, end, index.row) - rows.begin());
  }
  void SetZero() { std::fill(values.begin(), values.end(), Block6::Zero()); }
};

/// A zero matrix with the given blocks (any order, repeats allowed) and all diagonal ones.
[[nodiscard]] inline SymmetricBlockMatrix MakeBlockMatrix(uint32_t num_blocks,
                                                          std::vector<BlockIndex> pattern) {
  for (uint32_t i = 0; i < num_blocks; ++i) pattern.push_back({i, i});
  std::sort(pattern.begin(), pattern.end());
  pattern.erase(std::unique(pattern.begin(), pattern.end()), pattern.end());
  SymmetricBlockMatrix matrix;
  matrix.num_blocks = num_blocks;
  matrix.column_start.assign(num_blocks + 1, 0);
  for (const BlockIndex& index : pattern) {
    ++matrix.column_start[index.column + 1];
    matrix.rows.push_back(index.row);
  }
  for (uint32_t j = 0; j < num_blocks; ++j) matrix.column_start[j + 1] += matrix.column_start[j];
  matrix.values.assign(matrix.rows.size(), Block6::Zero());
  return matrix;
}

}  // namespace orbweave
