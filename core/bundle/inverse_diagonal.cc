// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/Core>

#include "core/base/status.h"
#include "core/bundle/block_cholesky.h"

namespace orbweave {
namespace {

Block6 InverseOfLower(const Block6& L) {
  return L.triangularView<Eigen::Lower>().solve(Block6::Identity());
}

}  // namespace

// From Z L = L^-T, by columns from the last to the first. With the rows k > j of column j of L,
//   Z_ij = -sum_k Z_ik M_k,   Z_jj = L_jj^-T L_jj^-1 - sum_k Z_kj^T M_k,   M_k = L_kj L_jj^-1.
// All Z_ik that occur lie in the pattern of L, because the rows of column j below k are rows of
// column k.
std::vector<Block6> BlockCholesky::InverseDiagonal() const {
  ORBWEAVE_CHECK(num_eliminated_ == num_blocks_);
  std::vector<Block6> Z(rows_.size(), Block6::Zero());
  std::vector<Block6> M;
  for (uint32_t j = num_blocks_; j-- > 0;) {
    const uint32_t first = column_start_[j] + 1;
    const uint32_t end = column_start_[j + 1];
    const Block6 inverse = InverseOfLower(values_[column_start_[j]]);
    M.clear();
    for (uint32_t p = first; p < end; ++p) M.push_back(values_[p] * inverse);
    for (uint32_t p = first; p < end; ++p) {
      uint32_t at = column_start_[rows_[p]];  // of Z_ik, for the rows i >= k of column j
      Z[p].noalias() -= Z[at] * M[p - first];
      for (uint32_t q = p + 1; q < end; ++q) {
        while (rows_[at] != rows_[q]) ++at;
        Z[q].noalias() -= Z[at] * M[p - first];
        Z[p].noalias() -= Z[at].transpose() * M[q - first];
      }
    }
    Block6& diagonal = Z[column_start_[j]];
    diagonal.noalias() = inverse.transpose() * inverse;
    for (uint32_t p = first; p < end; ++p) diagonal.noalias() -= Z[p].transpose() * M[p - first];
    diagonal = (0.5 * (diagonal + diagonal.transpose())).eval();
  }
  std::vector<Block6> result(num_blocks_);
  for (uint32_t i = 0; i < num_blocks_; ++i) result[i] = Z[column_start_[position_[i]]];
  return result;
}

}  // namespace orbweave
