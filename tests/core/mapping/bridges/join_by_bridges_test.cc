// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/join_by_bridges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/export_submodel.h"
#include "tests/core/mapping/broken_street.h"
#include "tests/core/mapping/model_error.h"

namespace orbweave {
namespace {

std::vector<MappingState> Join(BrokenStreet& street, std::vector<MappingState> submodels) {
  RegistrationLog log(BrokenStreet::kImages);
  auto joined =
      JoinByBridges(std::move(submodels), street.World().problem, street.Graph(), {}, log, {});
  EXPECT_TRUE(joined.ok()) << joined.status();
  return joined.ok() ? *std::move(joined) : std::vector<MappingState>();
}

std::vector<MappingState> Both(const BrokenStreet& street) {
  std::vector<MappingState> both;
  both.push_back(street.First());
  both.push_back(street.Second());
  return both;
}

TEST(JoinByBridges, MakesOneOfTwoSubmodelsThatOnePairAndGnssHoldTogether) {
  BrokenStreet street({.pairs_between = 1});
  const std::vector<MappingState> joined = Join(street, Both(street));
  ASSERT_EQ(joined.size(), 1U);
  const Reconstruction model = ExportSubmodel(joined[0]);
  EXPECT_EQ(model.images.size(), BrokenStreet::kImages);
  EXPECT_LT(ErrorOf(model, street.World().cams_from_world).position_rmse, 0.6);
  const auto spans_both = [](const Track& track) {
    return track.observations.front().ref.image.value < BrokenStreet::kFirstOfSecond &&
           track.observations.back().ref.image.value >= BrokenStreet::kFirstOfSecond;
  };
  EXPECT_GT(std::ranges::count_if(model.tracks, spans_both), 50);
}

TEST(JoinByBridges, LeavesApartWhatASinglePairWouldJoinWithoutGnss) {
  BrokenStreet street({.has_gnss = false, .pairs_between = 1});
  const std::vector<MappingState> before = Both(street);
  const std::vector<MappingState> joined = Join(street, Both(street));
  ASSERT_EQ(joined.size(), 2U);
  for (size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(joined[c].Registered(), before[c].Registered());
    EXPECT_EQ(joined[c].NumObservations(), before[c].NumObservations());
  }
}

TEST(JoinByBridges, LeavesApartWhatGnssContradicts) {
  BrokenStreet street({.pairs_between = 3});
  for (uint32_t i = BrokenStreet::kFirstOfSecond; i < BrokenStreet::kImages; ++i)
    *street.World().problem.images[i].prior.position_in_enu += Eigen::Vector3d(0.0, 40.0, 0.0);
  EXPECT_EQ(Join(street, Both(street)).size(), 2U);
}

TEST(JoinByBridges, TakesInAnImageThatNoSubmodelHolds) {
  BrokenStreet street({.pairs_between = 3});
  std::vector<MappingState> submodels;
  submodels.push_back(street.Part(0, 11, {}));
  const std::vector<MappingState> joined = Join(street, std::move(submodels));
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_GT(joined[0].Registered().size(), 11U);
}

TEST(JoinByBridges, LeavesNothingOfImagesThatNothingJoins) {
  BrokenStreet street({.pairs_between = 1});
  EXPECT_TRUE(Join(street, {}).empty());
}

TEST(JoinByBridges, StopsWhenAsked) {
  BrokenStreet street({.pairs_between = 1});
  std::stop_source stop;
  stop.request_stop();
  RegistrationLog log(BrokenStreet::kImages);
  const auto joined = JoinByBridges(
      Both(street), street.World().problem, street.Graph(), {}, log, {.stop = stop.get_token()});
  EXPECT_TRUE(absl::IsCancelled(joined.status()));
}

}  // namespace
}  // namespace orbweave
