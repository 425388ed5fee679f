// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/block_cholesky.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <cmath>
#include <limits>

namespace orbweave {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

uint32_t CountEliminated(uint32_t num_blocks, const std::vector<uint8_t>& is_retained) {
  const auto num_kept = std::count_if(
      is_retained.begin(), is_retained.end(), [](uint8_t retained) { return retained != 0; });
  return num_blocks - static_cast<uint32_t>(num_kept);
}

// position[block]: the eliminated blocks in the AMD order of their own graph, then the retained
// ones.
std::vector<uint32_t> EliminationPositions(const SymmetricBlockMatrix& pattern,
                                           const std::vector<uint8_t>& is_retained) {
  const int n = static_cast<int>(CountEliminated(pattern.num_blocks, is_retained));
  std::vector<uint32_t> block_of_node;
  std::vector<uint32_t> position(
      pattern.num_blocks);  // first the node, retained ones behind the others
  auto next_kept = static_cast<uint32_t>(n);
  for (uint32_t block = 0; block < pattern.num_blocks; ++block) {
    if (!is_retained.empty() && is_retained[block]) {
      position[block] = next_kept++;
    } else {
      position[block] = static_cast<uint32_t>(block_of_node.size());
      block_of_node.push_back(block);
    }
  }
  std::vector<Eigen::Triplet<double, int>> graph;
  graph.reserve(2 * pattern.rows.size());
  for (uint32_t column = 0; column < pattern.num_blocks; ++column) {
    const int j = static_cast<int>(position[column]);
    for (uint32_t p = pattern.column_start[column]; p < pattern.column_start[column + 1]; ++p) {
      const int i = static_cast<int>(position[pattern.rows[p]]);
      if (i >= n || j >= n) continue;
      graph.emplace_back(i, j, 1.0);
      if (i != j) graph.emplace_back(j, i, 1.0);
    }
  }
  Eigen::SparseMatrix<double> adjacency(n, n);
  adjacency.setFromTriplets(graph.begin(), graph.end());
  Eigen::AMDOrdering<int>::PermutationType block_at_position;
  Eigen::AMDOrdering<int>()(adjacency, block_at_position);
  for (int p = 0; p < n; ++p) {
    const auto node = static_cast<size_t>(block_at_position.indices()[p]);
    position[block_of_node[node]] = static_cast<uint32_t>(p);
  }
  return position;
}

// target -= a * b^T
void SubtractProduct(const Block6& a, const Block6& b, Block6& target) {
  for (int c = 0; c < 6; ++c) {
    Vector6 column = target.col(c);
    for (int k = 0; k < 6; ++k) column -= a.col(k) * b(c, k);
    target.col(c) = column;
  }
}

// Lower Cholesky factor in place; false unless positive definite.
bool FactorizeDense(Block6& A) {
  for (int j = 0; j < 6; ++j) {
    const double before = A(j, j);
    double pivot = before;
    for (int k = 0; k < j; ++k) pivot -= A(j, k) * A(j, k);
    // Also false for NaN. What remains of the pivot must be more than rounding of what was there.
    if (!(pivot > 1e-15 * std::abs(before)) || !std::isfinite(pivot)) return false;
    A(j, j) = std::sqrt(pivot);
    const double inverse = 1.0 / A(j, j);
    for (int i = j + 1; i < 6; ++i) {
      double sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= A(i, k) * A(j, k);
      A(i, j) = sum * inverse;
      A(j, i) = 0.0;
    }
  }
  return true;
}

// B := B L^-T for lower triangular L.
void DivideByTranspose(const Block6& L, Block6& B) {
  for (int j = 0; j < 6; ++j) {
    Vector6 column = B.col(j);
    for (int k = 0; k < j; ++k) column -= B.col(k) * L(j, k);
    B.col(j) = column / L(j, j);
  }
}

void SolveLower(const Block6& L, Vector6& x) {
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= L(i, k) * x[k];
    x[i] /= L(i, i);
  }
}

void SolveLowerTransposed(const Block6& L, Vector6& x) {
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] -= L(k, i) * x[k];
    x[i] /= L(i, i);
  }
}

}  // namespace

BlockCholesky::BlockCholesky(const SymmetricBlockMatrix& pattern,
                             const std::vector<uint8_t>& is_retained)
    : num_blocks_(pattern.num_blocks),
      num_eliminated_(CountEliminated(pattern.num_blocks, is_retained)),
      position_(EliminationPositions(pattern, is_retained)) {
  Analyze(pattern);
  values_.resize(rows_.size());
  slot_.resize(num_blocks_);
  next_row_.resize(num_blocks_);
  list_head_.resize(num_blocks_);
  list_next_.resize(num_blocks_);
}

// Where each block of A lands, and the pattern of L: a column holds the rows of A below its
// diagonal and those of its children in the elimination tree.
void BlockCholesky::Analyze(const SymmetricBlockMatrix& pattern) {
  std::vector<std::vector<Entry>> entries(num_blocks_);
  for (uint32_t j = 0; j < num_blocks_; ++j) {
    for (uint32_t p = pattern.column_start[j]; p < pattern.column_start[j + 1]; ++p) {
      const uint32_t a = position_[pattern.rows[p]];
      const uint32_t b = position_[j];
      entries[std::min(a, b)].push_back({p, std::max(a, b), a < b});
    }
  }
  std::vector<std::vector<uint32_t>> children(num_blocks_);
  std::vector<uint32_t> mark(num_blocks_, kNone);
  column_start_.assign(1, 0);
  entry_start_.assign(1, 0);
  for (uint32_t j = 0; j < num_blocks_; ++j) {
    const size_t first = rows_.size();
    const auto add = [&](uint32_t row) {
      if (row <= j || mark[row] == j) return;
      mark[row] = j;
      rows_.push_back(row);
    };
    rows_.push_back(j);
    for (const Entry& entry : entries[j]) add(entry.row);
    for (const uint32_t child : children[j]) {
      for (uint32_t p = column_start_[child]; p < column_start_[child + 1]; ++p) add(rows_[p]);
    }
    std::sort(rows_.begin() + static_cast<std::ptrdiff_t>(first), rows_.end());
    // What is left to do for an eliminated column is its parent's; retained ones have no parent,
    // and each takes its share.
    const bool is_eliminated = j < num_eliminated_;
    for (size_t p = first + 1; is_eliminated && p < rows_.size(); ++p) {
      children[rows_[p]].push_back(j);
      if (rows_[p] < num_eliminated_) break;
    }
    column_start_.push_back(static_cast<uint32_t>(rows_.size()));
    entries_.insert(entries_.end(), entries[j].begin(), entries[j].end());
    entry_start_.push_back(static_cast<uint32_t>(entries_.size()));
  }
}

void BlockCholesky::LoadColumn(const SymmetricBlockMatrix& matrix, uint32_t column) {
  for (uint32_t p = column_start_[column]; p < column_start_[column + 1]; ++p) {
    slot_[rows_[p]] = p;
    values_[p].setZero();
  }
  for (uint32_t e = entry_start_[column]; e < entry_start_[column + 1]; ++e) {
    const Entry& entry = entries_[e];
    const Block6& source = matrix.values[entry.source];
    if (entry.transposed) {
      values_[slot_[entry.row]] = source.transpose();
    } else {
      values_[slot_[entry.row]] = source;
    }
  }
}

bool BlockCholesky::FinishColumn(uint32_t column) {
  const uint32_t diagonal = column_start_[column];
  if (!FactorizeDense(values_[diagonal])) return false;
  for (uint32_t p = diagonal + 1; p < column_start_[column + 1]; ++p) {
    DivideByTranspose(values_[diagonal], values_[p]);
  }
  return true;
}

bool BlockCholesky::Factorize(const SymmetricBlockMatrix& matrix) {
  std::fill(list_head_.begin(), list_head_.end(), kNone);
  const auto enlist = [&](uint32_t column) {  // under the row of its next block
    if (next_row_[column] == column_start_[column + 1]) return;
    uint32_t& head = list_head_[rows_[next_row_[column]]];
    list_next_[column] = head;
    head = column;
  };
  for (uint32_t j = 0; j < num_blocks_; ++j) {
    LoadColumn(matrix, j);
    for (uint32_t k = list_head_[j]; k != kNone;) {
      const uint32_t following = list_next_[k];
      const uint32_t first = next_row_[k]++;
      for (uint32_t p = first; p < column_start_[k + 1]; ++p) {
        SubtractProduct(values_[p], values_[first], values_[slot_[rows_[p]]]);
      }
      enlist(k);
      k = following;
    }
    if (j >= num_eliminated_) continue;
    if (!FinishColumn(j)) return false;
    next_row_[j] = column_start_[j] + 1;
    enlist(j);
  }
  return true;
}

void BlockCholesky::Solve(std::vector<Vector6>& x) const {
  SolveForward(x);
  SolveBackward(x);
}

void BlockCholesky::SolveForward(std::vector<Vector6>& x) const {
  std::vector<Vector6> permuted(num_blocks_);
  for (uint32_t i = 0; i < num_blocks_; ++i) permuted[position_[i]] = x[i];
  for (uint32_t j = 0; j < num_eliminated_; ++j) {
    SolveLower(values_[column_start_[j]], permuted[j]);
    for (uint32_t p = column_start_[j] + 1; p < column_start_[j + 1]; ++p) {
      permuted[rows_[p]].noalias() -= values_[p] * permuted[j];
    }
  }
  for (uint32_t i = 0; i < num_blocks_; ++i) x[i] = permuted[position_[i]];
}

void BlockCholesky::SolveBackward(std::vector<Vector6>& x) const {
  std::vector<Vector6> permuted(num_blocks_);
  for (uint32_t i = 0; i < num_blocks_; ++i) permuted[position_[i]] = x[i];
  for (uint32_t j = num_eliminated_; j-- > 0;) {
    for (uint32_t p = column_start_[j] + 1; p < column_start_[j + 1]; ++p) {
      permuted[j].noalias() -= values_[p].transpose() * permuted[rows_[p]];
    }
    SolveLowerTransposed(values_[column_start_[j]], permuted[j]);
  }
  for (uint32_t i = 0; i < num_blocks_; ++i) x[i] = permuted[position_[i]];
}

SymmetricBlockMatrix BlockCholesky::Remaining() const {
  std::vector<BlockIndex> pattern;
  for (uint32_t j = num_eliminated_; j < num_blocks_; ++j) {
    for (uint32_t p = column_start_[j]; p < column_start_[j + 1]; ++p) {
      pattern.push_back({.column = rows_[p] - num_eliminated_, .row = j - num_eliminated_});
    }
  }
  SymmetricBlockMatrix remaining = MakeBlockMatrix(num_blocks_ - num_eliminated_, pattern);
  for (uint32_t j = num_eliminated_; j < num_blocks_; ++j) {
    for (uint32_t p = column_start_[j]; p < column_start_[j + 1]; ++p) {
      const BlockIndex index{.column = rows_[p] - num_eliminated_, .row = j - num_eliminated_};
      remaining.values[remaining.Find(index)] = values_[p].transpose();
    }
  }
  return remaining;
}

}  // namespace orbweave
