// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/find_seed_pairs.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

ClusterProblem ProblemOfImages(uint32_t count) {
  ClusterProblem problem;
  for (uint32_t i = 0; i < count; ++i) {
    problem.images.push_back(
        {.id = ImageId(i),
         .bearings = std::vector<Eigen::Vector3d>(300, Eigen::Vector3d::UnitZ()),
         .sigma_rad = std::vector<float>(300, 1e-3F),
         .colors = std::vector<Rgb>(300)});
  }
  return problem;
}

void AddPair(ClusterProblem& problem,
             uint32_t a,
             uint32_t b,
             uint32_t matches,
             double angle_deg,
             TwoViewKind kind = TwoViewKind::kGeneral) {
  TwoViewGeometry geometry{.pair = {ImageId(a), ImageId(b)}, .kind = kind};
  for (FeatureIndex f = 0; f < matches; ++f) geometry.inliers.push_back({f, f});
  // All bearings are equal in their cameras: the rays of a match meet under the rotation's angle.
  geometry.median_angle_rad = angle_deg * std::numbers::pi / 180.0;
  geometry.b_from_a.rotation = RotationFromVector({0.0, geometry.median_angle_rad, 0.0});
  problem.pairs.push_back(std::move(geometry));
}

std::vector<ImagePair> Find(const ClusterProblem& problem,
                            const MappingOptions& options,
                            std::vector<uint8_t> available = {}) {
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(problem).value();
  if (available.empty()) available.assign(problem.images.size(), 1);
  std::vector<ImagePair> pairs;
  for (const uint32_t p : FindSeedPairs(problem, graph, available, options)) {
    pairs.push_back(problem.pairs[graph.pairs[p].index].pair);
  }
  return pairs;
}

ImagePair Pair(uint32_t a, uint32_t b) { return {ImageId(a), ImageId(b)}; }

TEST(FindSeedPairs, TakesMostMatchesAmongThoseOfSufficientAngle) {
  ClusterProblem problem = ProblemOfImages(4);
  AddPair(problem, 0, 1, 300, 3.0);
  AddPair(problem, 0, 2, 120, 20.0);
  AddPair(problem, 0, 3, 150, 18.0);
  EXPECT_EQ(Find(problem, {}), (std::vector<ImagePair>{Pair(0, 3), Pair(0, 2), Pair(0, 1)}));
}

TEST(FindSeedPairs, RelaxesAngleAndMatchesStepByStep) {
  ClusterProblem problem = ProblemOfImages(4);
  AddPair(problem, 0, 1, 200, 5.0);
  AddPair(problem, 0, 2, 60, 20.0);
  AddPair(problem, 0, 3, 30, 20.0);
  EXPECT_EQ(Find(problem, {}), (std::vector<ImagePair>{Pair(0, 2), Pair(0, 1), Pair(0, 3)}));
}

TEST(FindSeedPairs, LeavesOutRotationsDepthlessPairsAndTakenImages) {
  ClusterProblem problem = ProblemOfImages(4);
  AddPair(problem, 0, 1, 300, 20.0, TwoViewKind::kPureRotation);
  AddPair(problem, 0, 2, 300, 1.0);
  AddPair(problem, 0, 3, 300, 20.0);
  AddPair(problem, 1, 2, 300, 20.0);
  EXPECT_EQ(Find(problem, {}, {1, 1, 1, 0}), (std::vector<ImagePair>{Pair(1, 2)}));
}

TEST(FindSeedPairs, TakesPlanesOnlyAfterGeneralPairs) {
  ClusterProblem problem = ProblemOfImages(3);
  AddPair(problem, 0, 1, 300, 20.0, TwoViewKind::kPlanar);
  AddPair(problem, 0, 2, 60, 9.0);
  EXPECT_EQ(Find(problem, {}), (std::vector<ImagePair>{Pair(0, 2), Pair(0, 1)}));
}

TEST(FindSeedPairs, PaperRanksTheFirstImageByItsMatches) {
  ClusterProblem problem = ProblemOfImages(5);
  AddPair(problem, 0, 1, 300, 20.0);
  AddPair(problem, 2, 3, 200, 20.0);
  AddPair(problem, 2, 4, 250, 20.0);
  MappingOptions options;
  EXPECT_EQ(Find(problem, options).front(), Pair(0, 1));
  options.preset = MappingPreset::kPaper;
  EXPECT_EQ(Find(problem, options).front(), Pair(2, 4));
}

TEST(FindSeedPairs, PaperTakesTheRuleAsPrinted) {
  ClusterProblem problem = ProblemOfImages(6);
  AddPair(problem, 0, 1, 220, 20.0);
  AddPair(problem, 0, 2, 300, 10.0);                        // not the angle
  AddPair(problem, 0, 3, 100, 30.0);                        // not more than 100
  AddPair(problem, 0, 4, 240, 20.0, TwoViewKind::kPlanar);  // a plane is a pair as others are
  AddPair(problem, 4, 5, 300, 20.0);
  MappingOptions options;
  options.preset = MappingPreset::kPaper;
  const std::vector<ImagePair> found = Find(problem, options);
  ASSERT_GE(found.size(), 3U);
  // Image 0 has 860 matches and comes first, image 4 has 540.
  EXPECT_EQ(found[0], Pair(0, 4));
  EXPECT_EQ(found[1], Pair(0, 1));
  EXPECT_EQ(found[2], Pair(4, 5));
}

}  // namespace
}  // namespace orbweave
