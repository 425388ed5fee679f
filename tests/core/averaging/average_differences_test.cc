// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_differences.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace orbweave {
namespace {

/// Nodes with random values of two columns, each joined with the next five.
struct World {
  Eigen::MatrixXd values{};
  DifferenceGraph graph{};
};

World MakeWorld(uint32_t nodes, double noise, double outlier_share, uint64_t seed) {
  Random random(seed);
  World world;
  world.values.resize(nodes, 2);
  for (uint32_t i = 0; i < nodes; ++i) {
    world.values.row(i) << random.Uniform(-5.0, 5.0), random.Uniform(-5.0, 5.0);
  }
  world.graph.num_nodes = nodes;
  std::vector<Eigen::RowVector2d> rows;
  for (uint32_t a = 0; a < nodes; ++a) {
    for (uint32_t b = a + 1; b < std::min(nodes, a + 6); ++b) {
      world.graph.edges.push_back({a, b});
      const bool is_wrong = random.Uniform() < outlier_share;
      const Eigen::RowVector2d error(random.Normal(), random.Normal());
      rows.push_back(world.values.row(b) - world.values.row(a) + (is_wrong ? 10.0 : noise) * error);
    }
  }
  world.graph.differences.resize(static_cast<Eigen::Index>(rows.size()), 2);
  for (size_t e = 0; e < rows.size(); ++e) {
    world.graph.differences.row(static_cast<Eigen::Index>(e)) = rows[e];
  }
  world.graph.weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size()));
  return world;
}

double WorstValue(const World& world, const Eigen::MatrixXd& found) {
  const Eigen::MatrixXd truth = world.values.rowwise() - world.values.row(0);
  return (found - truth).cwiseAbs().maxCoeff();
}

Eigen::MatrixXd Averaged(const World& world) {
  return AverageDifferences(world.graph, {}).value().values;
}

TEST(AverageDifferences, RecoversExactValues) {
  const World world = MakeWorld(50, 0.0, 0.0, 1);
  EXPECT_LT(WorstValue(world, Averaged(world)), 1e-10);
}

TEST(AverageDifferences, IsNotLedAstrayByAFifthOfWrongDifferences) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const World exact = MakeWorld(50, 0.0, 0.2, seed);
    EXPECT_LT(WorstValue(exact, Averaged(exact)), 1e-6) << seed;
    const World noisy = MakeWorld(50, 0.01, 0.2, seed);
    EXPECT_LT(WorstValue(noisy, Averaged(noisy)), 0.1) << seed;
  }
}

TEST(AverageDifferences, ScalesWithItsMeasurements) {
  World world = MakeWorld(20, 0.01, 0.1, 3);
  const Eigen::MatrixXd before = Averaged(world);
  world.graph.weights *= 7.0;  // only ratios of weights matter
  EXPECT_LT((Averaged(world) - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(AverageDifferences, FollowsTheHeavierOfTwoMeasurements) {
  DifferenceGraph graph{.num_nodes = 2, .edges = {{0, 1}, {0, 1}, {0, 1}}};
  graph.differences = Eigen::Vector3d(1.0, 1.1, 5.0);
  graph.weights = Eigen::Vector3d(100.0, 1.0, 1.0);
  const AveragedDifferences averaged = AverageDifferences(graph, {}).value();
  EXPECT_NEAR(averaged.values(1, 0), 1.0, 0.01);
  EXPECT_NEAR(averaged.error[2], 4.0, 0.01);
}

TEST(AverageDifferences, HoldsTheFirstNodeOfEveryPart) {
  DifferenceGraph graph{.num_nodes = 5, .edges = {{0, 1}, {3, 4}}};
  graph.differences = Eigen::Vector2d(2.0, -3.0);
  graph.weights = Eigen::Vector2d::Ones();
  const Eigen::MatrixXd values = AverageDifferences(graph, {}).value().values;
  EXPECT_EQ(values.rows(), 5);
  EXPECT_NEAR(values(1, 0), 2.0, 1e-12);
  EXPECT_NEAR(values(4, 0), -3.0, 1e-12);
  for (const int held : {0, 2, 3}) EXPECT_EQ(values(held, 0), 0.0);
}

}  // namespace
}  // namespace orbweave
