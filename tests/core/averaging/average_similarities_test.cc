// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_similarities.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/averaging/similarity_graph.h"
#include "tests/core/averaging/similarity_samples.h"

namespace orbweave {
namespace {

constexpr double kSigma = 0.01;

// Frames of random scale and pose, and the measurements between them.
struct World {
  std::vector<Sim3> world_from_node{};
  SimilarityGraph graph{};
};

World MakeNodes(uint32_t n, Random& random) {
  World world;
  for (uint32_t i = 0; i < n; ++i) {
    world.world_from_node.push_back(testing::RandomSimilarity(random));
    world.graph.node_length.push_back(10.0);
    world.graph.node_weight.push_back(i == 1 ? 2.0 : 1.0);
  }
  return world;
}

void Measure(World& world, uint32_t a, uint32_t b, const Vector7d& error, double strength = 100.0) {
  SimilarityEdge edge{.a = a, .b = b, .strength = strength};
  edge.measured.a_from_b = world.world_from_node[a].Inverse() * world.world_from_node[b];
  edge.measured.anchor_in_b = Eigen::Vector3d(1.0, 2.0, 3.0);
  edge.measured.length_in_a = 10.0;
  edge.measured.a_from_b = edge.measured.At(error);
  edge.information = Matrix7d::Identity() / (kSigma * kSigma);
  world.graph.edges.push_back(edge);
}

// A ring of n nodes with every second neighbour joined as well.
World MakeBracedRing(uint32_t n, double noise, Random& random) {
  World world = MakeNodes(n, random);
  for (uint32_t step : {1U, 2U}) {
    for (uint32_t i = 0; i < n; ++i) {
      Measure(world, i, (i + step) % n, testing::RandomVector7(random, noise));
    }
  }
  return world;
}

AveragedSimilarities Averaged(const SimilarityGraph& graph) {
  const auto averaged = AverageSimilarities(graph, {}, {});
  EXPECT_TRUE(averaged.ok()) << averaged.status();
  return averaged.ok() ? *averaged : AveragedSimilarities{};
}

// Largest coordinate by which two nodes lie otherwise to each other than in truth.
double WorstError(const World& world,
                  const AveragedSimilarities& averaged,
                  uint32_t a,
                  uint32_t b) {
  const SimilarityChart truth{
      .a_from_b = world.world_from_node[a].Inverse() * world.world_from_node[b],
      .length_in_a = 10.0};
  const Sim3 found = averaged.world_from_node[a].Inverse() * averaged.world_from_node[b];
  return truth.Of(found).cwiseAbs().maxCoeff();
}

TEST(AverageSimilarities, RecoversExactFrames) {
  Random random(1);
  const World world = MakeBracedRing(12, 0.0, random);
  const AveragedSimilarities averaged = Averaged(world.graph);
  for (uint32_t i = 1; i < 12; ++i) EXPECT_LT(WorstError(world, averaged, 0, i), 1e-9);
}

TEST(AverageSimilarities, TakesTheFrameOfTheHeaviestNode) {
  Random random(2);
  const AveragedSimilarities averaged = Averaged(MakeBracedRing(5, kSigma, random).graph);
  EXPECT_EQ(averaged.world_from_node[1].scale, 1.0);
  EXPECT_EQ(averaged.world_from_node[1].translation, Eigen::Vector3d::Zero());
}

TEST(AverageSimilarities, StaysNearTheTruthWithNoise) {
  Random random(3);
  const World world = MakeBracedRing(12, kSigma, random);
  const AveragedSimilarities averaged = Averaged(world.graph);
  EXPECT_EQ(std::count(averaged.is_used.begin(), averaged.is_used.end(), 1), 24);
  for (uint32_t i = 0; i < 12; ++i)
    EXPECT_LT(WorstError(world, averaged, i, (i + 1) % 12), 3.0 * kSigma);
}

TEST(AverageSimilarities, SpreadsTheErrorOfALoopOverItsEdges) {
  Random random(4);
  World world = MakeNodes(10, random);
  Vector7d gap = Vector7d::Zero();
  gap[1] = 10.0 * kSigma;
  for (uint32_t i = 0; i < 10; ++i)
    Measure(world, i, (i + 1) % 10, i == 4 ? gap : Vector7d::Zero());
  const AveragedSimilarities averaged = Averaged(world.graph);
  for (const uint8_t used : averaged.is_used) EXPECT_EQ(used, 1);
  EXPECT_LT(*std::max_element(averaged.error.begin(), averaged.error.end()), 2.5);
}

TEST(AverageSimilarities, SwitchesOffTheEdgesThatLoopsContradict) {
  Random random(5);
  World world = MakeBracedRing(12, kSigma, random);
  // Wrong, and stronger than all others: both lie in the maximum spanning tree.
  Measure(world, 0, 6, testing::RandomVector7(random, 1.0), 500.0);
  Measure(world, 3, 8, testing::RandomVector7(random, 1.0), 400.0);
  const AveragedSimilarities averaged = Averaged(world.graph);
  EXPECT_EQ(std::count(averaged.is_used.begin(), averaged.is_used.end(), 0), 2);
  EXPECT_EQ(averaged.is_used[24], 0);
  EXPECT_EQ(averaged.is_used[25], 0);
  EXPECT_GT(averaged.error[24], 8.0);
  for (uint32_t i = 0; i < 12; ++i)
    EXPECT_LT(WorstError(world, averaged, i, (i + 1) % 12), 4.0 * kSigma);
}

TEST(AverageSimilarities, BlamesTheWeakestEdgeOfALonelyLoop) {
  Random random(6);
  World world = MakeNodes(6, random);
  for (uint32_t i = 0; i < 6; ++i) {
    Measure(world,
            i,
            (i + 1) % 6,
            i == 2 ? testing::RandomVector7(random, 1.0) : Vector7d::Zero(),
            i == 2 ? 20.0 : 100.0);
  }
  const AveragedSimilarities averaged = Averaged(world.graph);
  for (size_t e = 0; e < 6; ++e) EXPECT_EQ(averaged.is_used[e], e == 2 ? 0 : 1);
  EXPECT_LT(WorstError(world, averaged, 0, 3), 1e-6);
}

TEST(AverageSimilarities, NeverSwitchesOffABridge) {
  Random random(7);
  World world = MakeNodes(2, random);
  Measure(world, 0, 1, testing::RandomVector7(random, 1.0));
  EXPECT_EQ(Averaged(world.graph).is_used[0], 1);
}

TEST(AverageSimilarities, TakesWhatAnEdgeSaysThatJoinsNothing) {
  Random random(9);
  World world = MakeNodes(3, random);
  Measure(world, 0, 1, Vector7d::Zero());
  Vector7d turned = Vector7d::Zero();
  turned[0] = 0.2;
  Measure(world, 0, 1, turned);  // off by twenty sigmas
  world.graph.edges.back().joins = false;
  Measure(world, 1, 2, Vector7d::Zero());
  world.graph.edges.back().joins = false;
  const AveragedSimilarities averaged = Averaged(world.graph);
  EXPECT_EQ(averaged.part, (std::vector<uint32_t>{0, 0, 1})) << "it holds nothing together";
  EXPECT_EQ(averaged.is_used, (std::vector<uint8_t>{1, 1, 1})) << "nor is it switched off";
  EXPECT_GT(WorstError(world, averaged, 0, 1), 1e-4) << "and yet it pulls";
}

TEST(AverageSimilarities, NumbersUnconnectedParts) {
  Random random(8);
  World world = MakeNodes(5, random);
  Measure(world, 0, 3, Vector7d::Zero());
  Measure(world, 2, 4, Vector7d::Zero());
  const AveragedSimilarities averaged = Averaged(world.graph);
  EXPECT_EQ(averaged.part, (std::vector<uint32_t>{0, 1, 2, 0, 2}));
  EXPECT_LT(WorstError(world, averaged, 0, 3), 1e-9);
  EXPECT_LT(WorstError(world, averaged, 2, 4), 1e-9);
}

TEST(AverageSimilarities, AcceptsNothing) { EXPECT_TRUE(Averaged({}).world_from_node.empty()); }

TEST(AverageSimilarities, StopsOnRequest) {
  Random random(9);
  std::stop_source stop;
  stop.request_stop();
  const auto averaged =
      AverageSimilarities(MakeBracedRing(6, kSigma, random).graph, {}, {.stop = stop.get_token()});
  EXPECT_EQ(averaged.status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
