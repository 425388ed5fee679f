// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/block_matrix.h"

namespace orbweave {

/// Sparse Cholesky factorisation P A P^T = L L^T of a symmetric positive definite matrix of 6x6
/// blocks, left-looking by block column. The fill-reducing order P is approximate minimum degree
/// on the block graph (Amestoy, Davis, Duff: AMD, SIAM J. Matrix Anal. 1996). No BLAS: the same
/// bits on every machine of the same build. The structure is analysed once, in the constructor.
class BlockCholesky {
 public:
  explicit BlockCholesky(const SymmetricBlockMatrix& pattern);

  /// Factorises values with the pattern of the constructor. False when the matrix is not
  /// (numerically) positive definite or not finite; Solve must not be called then.
  [[nodiscard]] bool Factorize(const SymmetricBlockMatrix& matrix);

  /// x := A^-1 x.
  void Solve(std::vector<Vector6>& x) const;

  /// Blocks in L, diagonal ones included.
  [[nodiscard]] size_t NumFactorBlocks() const { return rows_.size(); }

 private:
  void Analyze(const SymmetricBlockMatrix& pattern);
  void LoadColumn(const SymmetricBlockMatrix& matrix, uint32_t column);
  [[nodiscard]] bool FinishColumn(uint32_t column);

  uint32_t num_blocks_ = 0;
  std::vector<uint32_t> position_{};      // of a block of A in the elimination order
  std::vector<uint32_t> column_start_{};  // of L
  std::vector<uint32_t> rows_{};          // of L, ascending, diagonal first
  std::vector<Block6> values_{};          // of L
  struct Entry {                          // a block of A that lands in a column of L
    uint32_t source = 0;
    uint32_t row = 0;
    bool transposed = false;
  };
  std::vector<uint32_t> entry_start_{};
  std::vector<Entry> entries_{};
  // Workspaces of Factorize: place of a row in the current column; lists of columns by next row.
  std::vector<uint32_t> slot_{};
  std::vector<uint32_t> next_row_{};
  std::vector<uint32_t> list_head_{};
  std::vector<uint32_t> list_next_{};
  mutable std::vector<Vector6> permuted_{};
};

}  // namespace orbweave
