// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/merge_points.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

/// Points of images {0, 1} and of {2, 3} of the same street, not joined.
MappingState HalvesOf(const StreetFixture& street) {
  MappingState state = street.StateWith({0, 1, 2, 3});
  for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(2U, 3U)}) {
    for (FeatureIndex f = 0; f < street.world.problem.images[a].bearings.size(); ++f) {
      const Node node = street.graph.node_of_feature[a][f];
      for (const Node other : street.graph.Neighbours(node)) {
        if (street.graph.image_of_node[other] == b && state.PointOf(other) == kNoPoint) {
          CreatePoint(state, node, {&other, 1}, TrackLimits{});
          break;
        }
      }
    }
  }
  return state;
}

TEST(MergePoints, JoinsTheHalvesOfTracks) {
  const StreetFixture street({.centres = StraightWalk(4, 2.0), .noise_px = 0.3});
  MappingState state = HalvesOf(street);
  const uint32_t observations = state.NumObservations();
  const uint32_t merged = MergePoints(state, AllPoints(state), 4.0);
  EXPECT_GT(merged, 20U);
  EXPECT_EQ(state.NumObservations(), observations);
  for (const PointIndex point : AllPoints(state)) {
    for (const Node node : state.Point(point).nodes) {
      EXPECT_EQ(street.TruePoint(node), street.TruePoint(state.Point(point).nodes.front()));
    }
  }
  EXPECT_EQ(MergePoints(state, AllPoints(state), 4.0), 0U);
}

TEST(MergePoints, KeepsPointsApartThatWrongMatchesJoin) {
  const StreetFixture street({.centres = StraightWalk(4, 2.0), .outlier_share = 0.3});
  MappingState state = HalvesOf(street);
  MergePoints(state, AllPoints(state), 4.0);
  uint32_t wrong = 0;
  for (const PointIndex point : AllPoints(state)) {
    for (const Node node : state.Point(point).nodes) {
      wrong += street.TruePoint(node) != street.TruePoint(state.Point(point).nodes.front()) ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, 0.03 * state.NumObservations());
}

TEST(MergePoints, KeepsTheBetterOfTwoFeaturesOfOneImage) {
  // One scene point, found twice in image 1 (a keypoint with two orientations): features 0 and 1.
  ClusterProblem problem;
  const Eigen::Vector3d X(1.0, 0.0, 5.0);
  const std::vector<Eigen::Vector3d> centres = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  for (uint32_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d exact = (X - centres[i]).normalized();
    const Eigen::Vector3d off = (exact + 2e-3 * Eigen::Vector3d::UnitY()).normalized();
    problem.images.push_back({.id = ImageId(i),
                              .camera = kStreetCamera,
                              .bearings = {exact, off},
                              .sigma_rad = {1e-3F, 1e-3F},
                              .colors = {Rgb{}, Rgb{}}});
  }
  const auto pair = [](uint32_t a, uint32_t b, FeatureMatch match) {
    return TwoViewGeometry{
        .pair = {ImageId(a), ImageId(b)}, .kind = TwoViewKind::kGeneral, .inliers = {match}};
  };
  problem.pairs = {pair(0, 1, {0, 0}), pair(0, 2, {0, 0}), pair(1, 2, {1, 0})};
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(problem).value();
  MappingState state(problem, graph);
  for (ImageSlot i = 0; i < 3; ++i) {
    state.Register(i, Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centres[i]));
  }
  const std::vector<Node> first = {graph.node_of_feature[0][0], graph.node_of_feature[1][0]};
  const std::vector<Node> second = {graph.node_of_feature[1][1], graph.node_of_feature[2][0]};
  state.AddPoint(X, first);
  state.AddPoint(X, second);
  EXPECT_EQ(MergePoints(state, AllPoints(state), 4.0), 1U);
  ASSERT_EQ(state.NumPoints(), 1U);
  EXPECT_EQ(state.NumObservations(), 3U);
  EXPECT_NE(state.PointOf(graph.node_of_feature[1][0]), kNoPoint);
  EXPECT_EQ(state.PointOf(graph.node_of_feature[1][1]), kNoPoint);
}

}  // namespace
}  // namespace orbweave
