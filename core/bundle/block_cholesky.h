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
///
/// Some blocks may be retained: the others are eliminated, and their Schur complement remains.
class BlockCholesky {
 public:
  /// `is_retained` per block; empty: none.
  explicit BlockCholesky(const SymmetricBlockMatrix& pattern,
                         const std::vector<uint8_t>& is_retained = {});

  /// Factorises values with the pattern of the constructor. False when the matrix is not
  /// (numerically) positive definite, as far as it is eliminated; nothing below may be called then.
  [[nodiscard]] bool Factorize(const SymmetricBlockMatrix& matrix);

  /// x := A^-1 x. Any number of threads may solve with one factorisation.
  void Solve(std::vector<Vector6>& x) const;

  /// Solve is both, one after the other. Forward: eliminated blocks x_e := L^-1 x_e, retained ones
  /// x_k := x_k - A_ke A_ee^-1 x_e. Backward: x_e := L^-T (x_e - L_ke^T x_k), where x_k is the
  /// solution of the retained blocks.
  void SolveForward(std::vector<Vector6>& x) const;
  void SolveBackward(std::vector<Vector6>& x) const;

  /// A_kk - A_ke A_ee^-1 A_ek, blocks in the order of A.
  [[nodiscard]] SymmetricBlockMatrix Remaining() const;
  /// The diagonal blocks of A^-1, by the sparse inverse subset: of A^-1 only the blocks in the
  /// pattern of L are formed (Takahashi 1973, Erisman 1975), at about the cost of Factorize, which
  /// must have succeeded; no block may be retained.
  [[nodiscard]] std::vector<Block6> InverseDiagonal() const;

  /// Blocks in L, diagonal ones included.
  [[nodiscard]] size_t NumFactorBlocks() const { return rows_.size(); }

 private:
  void Analyze(const SymmetricBlockMatrix& pattern);
  void LoadColumn(const SymmetricBlockMatrix& matrix, uint32_t column);
  [[nodiscard]] bool FinishColumn(uint32_t column);

  uint32_t num_blocks_ = 0;
  uint32_t num_eliminated_ = 0;           // the retained blocks come last, in the order of A
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
};

}  // namespace orbweave
