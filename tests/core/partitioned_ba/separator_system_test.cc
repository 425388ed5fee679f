// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/separator_system.h"

#include <gtest/gtest.h>

#include <array>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kLambda = 1e-3;

SeparatorId Pose(uint32_t index) { return {SeparatorId::Kind::kPose, index}; }

// Positive definite, dense over its variables.
SeparatorSystem RandomSystem(const std::vector<SeparatorId>& variables, uint64_t seed) {
  Random random(seed);
  const auto n = static_cast<uint32_t>(variables.size());
  std::vector<BlockIndex> pattern;
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i <= j; ++i) pattern.push_back({.column = j, .row = i});
  }
  SeparatorSystem system{.variables = variables,
                         .normal = MakeNormalSystem(MakeBlockMatrix(n, pattern))};
  for (Block6& block : system.normal.S.values) {
    for (double& x : block.reshaped()) x = random.Uniform(-1, 1);
  }
  for (uint32_t i = 0; i < n; ++i) {
    Block6& block = system.normal.S.Diagonal(i);
    block = (block + block.transpose()).eval();
    block.diagonal().array() += 20.0;
    for (double& x : system.normal.rhs[i]) x = random.Uniform(-1, 1);
    for (double& x : system.normal.gradient[i]) x = random.Uniform(-1, 1);
    system.normal.trace[i] = {60.0, 60.0};
  }
  return system;
}

// Left to right: 0 - 1 - 2 - 3, each neighbour pair with a variable of its own between.
std::array<SeparatorSystem, 3> Chain() {
  return {RandomSystem({Pose(0), Pose(1)}, 1),
          RandomSystem({Pose(1), Pose(2)}, 2),
          RandomSystem({Pose(2), Pose(3)}, 3)};
}

double LargestDifference(const SeparatorStep& a, const SeparatorStep& b) {
  EXPECT_EQ(a.variables, b.variables);
  double largest = 0.0;
  for (size_t i = 0; i < a.steps.size(); ++i) {
    largest = std::max(largest, (a.steps[i] - b.steps[i]).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(SeparatorSystem, NestedEliminationSolvesTheWhole) {
  const std::array<SeparatorSystem, 3> chain = Chain();
  const std::optional<SeparatorStep> whole = SolveSeparators(AddSystems(chain), {}, kLambda);
  ASSERT_TRUE(whole.has_value());

  const SeparatorSystem left = AddSystems(std::span(chain).first(2));
  const SeparatorSystem left_end = EliminateSeparators(left, {Pose(2)}, kLambda);
  const std::array<SeparatorSystem, 2> top = {left_end, chain[2]};
  const std::optional<SeparatorStep> right = SolveSeparators(AddSystems(top), {}, kLambda);
  ASSERT_TRUE(right.has_value());
  const std::optional<SeparatorStep> rest =
      SolveSeparators(left, Restricted(*right, {Pose(2)}), kLambda);
  ASSERT_TRUE(rest.has_value());

  EXPECT_LT(LargestDifference(Restricted(*whole, right->variables), *right), 1e-14);
  EXPECT_LT(LargestDifference(Restricted(*whole, rest->variables), *rest), 1e-14);
  EXPECT_NEAR(
      right->predicted_decrease + rest->predicted_decrease, whole->predicted_decrease, 1e-13);
}

TEST(SeparatorSystem, StepSolvesTheDampedEquations) {
  const SeparatorSystem system = RandomSystem({Pose(4), Pose(9), Pose(11)}, 4);
  const std::optional<SeparatorStep> step = SolveSeparators(system, {}, kLambda);
  ASSERT_TRUE(step.has_value());
  const SymmetricBlockMatrix& S = system.normal.S;
  for (uint32_t i = 0; i < 3; ++i) {
    Vector6 residual = kLambda * 20.0 * step->steps[i] - system.normal.rhs[i];
    for (uint32_t j = 0; j < 3; ++j) {
      const BlockIndex index{.column = std::max(i, j), .row = std::min(i, j)};
      const Block6& block = S.values[S.Find(index)];
      residual += (j >= i ? block : Block6(block.transpose())) * step->steps[j];
    }
    EXPECT_LT(residual.norm(), 1e-13);
  }
}

TEST(SeparatorSystem, FailureGoesUp) {
  std::array<SeparatorSystem, 3> chain = Chain();
  chain[1] = {.is_definite = false};
  const SeparatorSystem sum = AddSystems(chain);
  EXPECT_FALSE(sum.is_definite);
  EXPECT_FALSE(EliminateSeparators(sum, {}, kLambda).is_definite);
  EXPECT_FALSE(SolveSeparators(sum, {}, kLambda).has_value());
}

TEST(SeparatorSystem, FailsWhenNotPositiveDefinite) {
  SeparatorSystem system = RandomSystem({Pose(0), Pose(1)}, 5);
  system.normal.S.Diagonal(1) *= -1.0;
  EXPECT_FALSE(SolveSeparators(system, {}, kLambda).has_value());
  EXPECT_FALSE(EliminateSeparators(system, {Pose(0)}, kLambda).is_definite);
  EXPECT_TRUE(EliminateSeparators(system, {Pose(1)}, kLambda).is_definite);
}

TEST(SeparatorSystem, SumOfNothingIsEmptyAndSolved) {
  const std::optional<SeparatorStep> step = SolveSeparators(AddSystems({}), {}, kLambda);
  ASSERT_TRUE(step.has_value());
  EXPECT_TRUE(step->variables.empty());
  EXPECT_EQ(step->predicted_decrease, 0.0);
}

}  // namespace
}  // namespace orbweave
