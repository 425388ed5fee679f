// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/cut_at_hinges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/mapping/cuts/parts_that_pairs_hold.h"
#include "tests/core/mapping/broken_street.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;

enum class Seen { kByThree, kByTwo };

/// The street with its second half hung on to the first: on a scale of its own about where it
/// begins, with so many points that both halves see.
MappingState Hung(const BrokenStreet& street,
                  double scale,
                  uint32_t num_common,
                  Seen seen = Seen::kByThree) {
  MappingState state = street.First();
  const MappingState second = street.Part(BrokenStreet::kFirstOfSecond, BrokenStreet::kImages, {});
  const Eigen::Vector3d pivot = state.Centre(BrokenStreet::kFirstOfSecond - 1);
  const Sim3 moved{scale, Eigen::Quaterniond::Identity(), (1.0 - scale) * pivot};
  for (const ImageSlot image : second.Registered())
    state.Register(image, TransformCamera(moved, second.CamFromWorld(image)));
  for (PointIndex p = 0; p < second.EndOfPoints(); ++p) {
    if (second.Exists(p)) state.AddPoint(moved * second.Point(p).position, second.Point(p).nodes);
  }
  for (const LinkedPair& pair : street.Graph().pairs) {
    const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
    if (!BrokenStreet::IsBetween(geometry)) continue;
    for (const FeatureMatch& match : geometry.inliers) {
      const Node a = street.Graph().node_of_feature[pair.a][match.a];
      const Node b = street.Graph().node_of_feature[pair.b][match.b];
      if (num_common == 0 || state.PointOf(b) == kNoPoint) continue;
      if (state.PointOf(a) != kNoPoint) state.RemovePoint(state.PointOf(a));
      if (seen == Seen::kByTwo) {
        const Eigen::Vector3d position = state.Point(state.PointOf(b)).position;
        state.RemovePoint(state.PointOf(b));
        state.AddPoint(position, std::array{a, b});
      } else {
        state.AddObservation(state.PointOf(b), a);
      }
      --num_common;
    }
  }
  EXPECT_EQ(num_common, 0U);
  return state;
}

std::vector<size_t> SizesOf(const std::vector<MappingState>& pieces) {
  std::vector<size_t> sizes;
  for (const MappingState& piece : pieces) sizes.push_back(piece.Registered().size());
  return sizes;
}

TEST(CutAtHinges, CutsOffAStreetOnAnotherScale) {
  const BrokenStreet street({.pairs_between = 4});
  for (const double scale : {0.28, 2.5}) {
    const MappingState hung = Hung(street, scale, 6);
    const std::vector<MappingState> pieces = CutAtHinges(hung, {});
    ASSERT_THAT(SizesOf(pieces), ElementsAre(12U, 12U)) << scale;
    for (const MappingState& piece : pieces) {
      const bool is_second = piece.IsRegistered(BrokenStreet::kImages - 1);
      for (const ImageSlot image : piece.Registered()) {
        EXPECT_EQ(image >= BrokenStreet::kFirstOfSecond, is_second);
        EXPECT_EQ(piece.Centre(image), hung.Centre(image));
        EXPECT_GT(piece.NumObservations(image), 0U);
      }
    }
  }
}

TEST(CutAtHinges, LeavesWhatGnssBearsOut) {
  const BrokenStreet street({.pairs_between = 4});
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 1.0, 6), {})), ElementsAre(24U));
}

/// A pair between the halves, the only one, that has the second turned by 40 degrees.
TEST(CutAtHinges, LeavesWhatGnssBearsOutThoughThePairBetweenContradictsIt) {
  BrokenStreet street({.pairs_between = 1});
  street.DetachPairsBetween();
  ClusterProblem& problem = street.World().problem;
  const auto between = std::ranges::find_if(problem.pairs, &BrokenStreet::IsBetween);
  const Rigid3 turn{RotationFromVector({0.0, 0.7, 0.0}), Eigen::Vector3d::Zero()};
  between->b_from_a = turn * between->b_from_a;
  std::vector<Eigen::Vector3d>& bearings = problem.images[between->pair.b.value].bearings;
  for (const FeatureMatch& match : between->inliers)
    bearings[match.b] = turn.rotation * bearings[match.b];
  street.Rebuild();
  MappingState whole = Hung(street, 1.0, 0);
  for (size_t i = 0; i < 6; ++i) {
    const auto& [a, b] = between->inliers[i];
    const CorrespondenceGraph& graph = street.Graph();
    whole.AddPoint(whole.Centre(between->pair.a.value) + Eigen::Vector3d::UnitZ(),
                   std::array{graph.node_of_feature[between->pair.a.value][a],
                              graph.node_of_feature[between->pair.b.value][b]});
  }
  EXPECT_EQ(PartsThatPairsHold(whole, {}).size(), 2U);
  EXPECT_THAT(SizesOf(CutAtHinges(whole, {})), ElementsAre(24U));
}

TEST(CutAtHinges, LeavesWhatIsHardlyBentHoweverExactPositionsAre) {
  BrokenStreet street({.pairs_between = 4});
  for (uint32_t i = 0; i < BrokenStreet::kImages; ++i) {
    PosePrior& prior = street.World().problem.images[i].prior;
    prior.position_in_enu = street.PlaceInEnu(i);
    prior.horizontal_sigma_m = 0.5;
  }
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 0.9, 6), {})), ElementsAre(24U));
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 0.7, 6), {})), ElementsAre(12U, 12U));
}

TEST(CutAtHinges, LeavesWhatPointsHold) {
  const BrokenStreet street({.pairs_between = 4});
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 0.28, 300), {})), ElementsAre(24U));
}

TEST(CutAtHinges, CutsWhatHangsAtPointsOfTwoPanoramasHoweverMany) {
  const BrokenStreet street({.pairs_between = 4});
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 0.28, 40, Seen::kByTwo), {})),
              ElementsAre(12U, 12U));
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(street, 1.0, 40, Seen::kByTwo), {})), ElementsAre(24U));
}

TEST(CutAtHinges, CutsWhatNeitherPointsNorGnssTellTheSizeOf) {
  const BrokenStreet silent({.has_gnss = false, .pairs_between = 4});
  for (const double scale : {0.28, 1.0})
    EXPECT_THAT(SizesOf(CutAtHinges(Hung(silent, scale, 6), {})), ElementsAre(12U, 12U)) << scale;
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(silent, 1.0, 300), {})), ElementsAre(24U));
  BrokenStreet scattered({.pairs_between = 4});
  Random random(3);
  for (uint32_t i = BrokenStreet::kFirstOfSecond; i < BrokenStreet::kImages; ++i) {
    *scattered.World().problem.images[i].prior.position_in_enu +=
        30.0 * Eigen::Vector3d(random.Normal(), random.Normal(), 0.0);
  }
  EXPECT_THAT(SizesOf(CutAtHinges(Hung(scattered, 0.28, 6), {})), ElementsAre(12U, 12U));
}

}  // namespace
}  // namespace orbweave
