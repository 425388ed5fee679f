// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/LU>
#include <limits>

#include "core/base/parallel_for.h"
#include "core/base/random.h"

namespace orbweave {
namespace {

// A ring with chords and one block joined to all: bands, loops and an arrow.
SymmetricBlockMatrix RandomMatrix(uint32_t num_blocks, uint64_t seed) {
  std::vector<BlockIndex> pattern;
  for (uint32_t i = 0; i < num_blocks; ++i) {
    for (const uint32_t j : {(i + 1) % num_blocks, (i + 3) % num_blocks, num_blocks - 1}) {
      pattern.push_back({.column = std::max(i, j), .row = std::min(i, j)});
    }
  }
  SymmetricBlockMatrix matrix = MakeBlockMatrix(num_blocks, pattern);
  Random random(seed);
  for (Block6& block : matrix.values) {
    for (double& x : block.reshaped()) x = random.Uniform(-1, 1);
  }
  for (uint32_t i = 0; i < num_blocks; ++i) {
    Block6& block = matrix.Diagonal(i);
    block = (block + block.transpose()).eval();
    block.diagonal().array() += 6.0 * num_blocks;
  }
  return matrix;
}

Eigen::MatrixXd Dense(const SymmetricBlockMatrix& matrix) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * matrix.num_blocks, 6 * matrix.num_blocks);
  for (uint32_t j = 0; j < matrix.num_blocks; ++j) {
    for (uint32_t p = matrix.column_start[j]; p < matrix.column_start[j + 1]; ++p) {
      dense.block<6, 6>(6 * matrix.rows[p], 6 * j) = matrix.values[p];
      dense.block<6, 6>(6 * j, 6 * matrix.rows[p]) = matrix.values[p].transpose();
    }
  }
  return dense;
}

TEST(BlockCholesky, SolvesWhatDenseCholeskySolves) {
  for (const uint32_t num_blocks : {1U, 2U, 5U, 40U}) {
    const SymmetricBlockMatrix matrix = RandomMatrix(num_blocks, num_blocks);
    Random random(7);
    std::vector<Vector6> x(num_blocks);
    for (Vector6& block : x) {
      for (double& value : block) value = random.Normal();
    }
    Eigen::VectorXd b(6 * num_blocks);
    for (uint32_t i = 0; i < num_blocks; ++i) b.segment<6>(6 * i) = x[i];
    BlockCholesky cholesky(matrix);
    ASSERT_TRUE(cholesky.Factorize(matrix));
    cholesky.Solve(x);
    const Eigen::VectorXd expected = Dense(matrix).llt().solve(b);
    for (uint32_t i = 0; i < num_blocks; ++i) {
      EXPECT_LT((x[i] - expected.segment<6>(6 * i)).norm(), 1e-12 * expected.norm());
    }
  }
}

TEST(BlockCholesky, HasTheDiagonalOfTheDenseInverse) {
  for (const uint32_t num_blocks : {1U, 2U, 5U, 40U}) {
    const SymmetricBlockMatrix matrix = RandomMatrix(num_blocks, num_blocks);
    BlockCholesky cholesky(matrix);
    ASSERT_TRUE(cholesky.Factorize(matrix));
    const std::vector<Block6> diagonal = cholesky.InverseDiagonal();
    const Eigen::MatrixXd expected = Dense(matrix).inverse();
    for (uint32_t i = 0; i < num_blocks; ++i) {
      EXPECT_LT((diagonal[i] - expected.block<6, 6>(6 * i, 6 * i)).norm(), 1e-12 * expected.norm());
      EXPECT_EQ(diagonal[i], diagonal[i].transpose());
    }
  }
}

TEST(BlockCholesky, LeavesTheSchurComplementOfSubproblemCache) {
  const uint32_t num_blocks = 12;
  const SymmetricBlockMatrix matrix = RandomMatrix(num_blocks, 5);
  std::vector<uint8_t> is_retained(num_blocks, 0);
  for (const size_t block : {1U, 4U, 10U}) is_retained[block] = 1;
  BlockCholesky cholesky(matrix, is_retained);
  ASSERT_TRUE(cholesky.Factorize(matrix));
  // The inverse of the complement is the retained part of the inverse.
  const Eigen::MatrixXd inverse = Dense(matrix).inverse();
  const Eigen::MatrixXd complement = Dense(cholesky.Remaining());
  Eigen::MatrixXd kept_inverse(18, 18);
  const Eigen::Index retained[] = {1, 4, 10};
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      kept_inverse.block<6, 6>(6 * i, 6 * j) =
          inverse.block<6, 6>(6 * retained[i], 6 * retained[j]);
    }
  }
  EXPECT_LT((complement * kept_inverse - Eigen::MatrixXd::Identity(18, 18)).norm(), 1e-12);

  std::vector<Vector6> x(num_blocks, Vector6::Ones());
  cholesky.SolveForward(x);
  Eigen::VectorXd kept_rhs(18);
  for (Eigen::Index i = 0; i < 3; ++i) {
    kept_rhs.segment<6>(6 * i) = x[static_cast<size_t>(retained[i])];
  }
  const Eigen::VectorXd kept_solution = complement.llt().solve(kept_rhs);
  for (Eigen::Index i = 0; i < 3; ++i) {
    x[static_cast<size_t>(retained[i])] = kept_solution.segment<6>(6 * i);
  }
  cholesky.SolveBackward(x);
  const Eigen::VectorXd expected = inverse * Eigen::VectorXd::Ones(6 * num_blocks);
  for (uint32_t i = 0; i < num_blocks; ++i) {
    EXPECT_LT((x[i] - expected.segment<6>(6 * i)).norm(), 1e-12);
  }
}

TEST(BlockCholesky, IsSolvedByManyThreadsAtOnce) {
  const uint32_t num_blocks = 200;
  const SymmetricBlockMatrix matrix = RandomMatrix(num_blocks, 11);
  BlockCholesky cholesky(matrix);
  ASSERT_TRUE(cholesky.Factorize(matrix));
  const size_t num_solves = 64;
  std::vector<std::vector<Vector6>> alone;
  for (size_t k = 0; k < num_solves; ++k) {
    alone.emplace_back(num_blocks, Vector6::Constant(1.0 + static_cast<double>(k)));
    cholesky.Solve(alone.back());
  }
  std::vector<std::vector<Vector6>> together(num_solves);
  ParallelFor(num_solves, 8, [&](size_t k) {
    together[k].assign(num_blocks, Vector6::Constant(1.0 + static_cast<double>(k)));
    cholesky.Solve(together[k]);
  });
  EXPECT_EQ(together, alone);
}

TEST(BlockCholesky, KeepsABandSparse) {
  std::vector<BlockIndex> pattern;
  for (uint32_t i = 0; i + 1 < 500; ++i) pattern.push_back({.column = i + 1, .row = i});
  const BlockCholesky cholesky(MakeBlockMatrix(500, pattern));
  EXPECT_EQ(cholesky.NumFactorBlocks(), 999U);
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  SymmetricBlockMatrix matrix = RandomMatrix(6, 3);
  BlockCholesky cholesky(matrix);
  EXPECT_TRUE(cholesky.Factorize(matrix));
  matrix.Diagonal(2)(4, 4) = -1.0;
  EXPECT_FALSE(cholesky.Factorize(matrix));
  matrix.Diagonal(2)(4, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.Factorize(matrix));
}

}  // namespace
}  // namespace orbweave
