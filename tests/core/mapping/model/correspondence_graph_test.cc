// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/correspondence_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/mapping/ray_street.h"

namespace orbweave {
namespace {

TEST(BuildCorrespondenceGraph, IsSymmetricAndSorted) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(6, 3.0), .outlier_share = 0.2});
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(world.problem).value();
  size_t edges = 0;
  for (Node node = 0; node < graph.NumNodes(); ++node) {
    const auto neighbours = graph.Neighbours(node);
    EXPECT_TRUE(std::ranges::is_sorted(neighbours));
    for (const Node other : neighbours) {
      EXPECT_NE(graph.image_of_node[node], graph.image_of_node[other]);
      EXPECT_TRUE(std::ranges::binary_search(graph.Neighbours(other), node));
      ++edges;
    }
  }
  size_t matches = 0;
  for (const TwoViewGeometry& pair : world.problem.pairs) matches += pair.inliers.size();
  EXPECT_EQ(edges, 2 * matches);
}

TEST(BuildCorrespondenceGraph, NodesLeadBackToTheirFeatures) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(4, 3.0)});
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(world.problem).value();
  for (ImageSlot image = 0; image < graph.NumImages(); ++image) {
    for (FeatureIndex f = 0; f < world.problem.images[image].bearings.size(); ++f) {
      const Node node = graph.node_of_feature[image][f];
      EXPECT_EQ(graph.image_of_node[node], image);
      EXPECT_EQ(graph.feature_of_node[node], f);
      EXPECT_EQ(graph.bearing_of_node[node], world.problem.images[image].bearings[f]);
    }
  }
}

TEST(BuildCorrespondenceGraph, FeaturesOfOneBearingAreOneNode) {
  RayStreet world = MakeStreet({.centres = StraightWalk(2, 3.0)});
  ClusterImage& image = world.problem.images[0];
  const auto count = static_cast<FeatureIndex>(image.bearings.size());
  image.bearings.push_back(image.bearings[2]);
  image.sigma_rad.push_back(image.sigma_rad[2]);
  image.colors.push_back(image.colors[2]);
  world.problem.pairs[0].inliers.push_back({count, 5});
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(world.problem).value();
  EXPECT_EQ(graph.first_node[1], count);
  EXPECT_EQ(graph.node_of_feature[0][count], graph.node_of_feature[0][2]);
  EXPECT_EQ(graph.feature_of_node[graph.node_of_feature[0][2]], 2U);
  const auto neighbours = graph.Neighbours(graph.node_of_feature[0][2]);
  EXPECT_TRUE(std::ranges::binary_search(neighbours, graph.node_of_feature[1][5]));
}

TEST(BuildCorrespondenceGraph, LeavesOutPairsWithoutGeometry) {
  RayStreet world = MakeStreet({.centres = StraightWalk(3, 3.0)});
  ASSERT_EQ(world.problem.pairs.size(), 3U);
  world.problem.pairs[1].kind = TwoViewKind::kNone;
  EXPECT_EQ(BuildCorrespondenceGraph(world.problem).value().pairs.size(), 2U);
}

TEST(BuildCorrespondenceGraph, RefusesAPairOfAnImageThatIsNotThere) {
  RayStreet world = MakeStreet({.centres = StraightWalk(3, 3.0)});
  world.problem.pairs.back().pair.b = ImageId(77);
  const auto graph = BuildCorrespondenceGraph(world.problem);
  EXPECT_EQ(graph.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(graph.status().message().find("77"), std::string::npos);
}

TEST(BuildCorrespondenceGraph, RefusesAMatchOfAFeatureThatIsNotThere) {
  RayStreet world = MakeStreet({.centres = StraightWalk(3, 3.0)});
  world.problem.pairs[0].inliers[0].b = 1000000;
  EXPECT_EQ(BuildCorrespondenceGraph(world.problem).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(BuildCorrespondenceGraph, RefusesImagesOutOfOrder) {
  RayStreet world = MakeStreet({.centres = StraightWalk(3, 3.0)});
  world.problem.pairs.clear();
  std::swap(world.problem.images[0], world.problem.images[1]);
  EXPECT_EQ(BuildCorrespondenceGraph(world.problem).status().code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace orbweave
