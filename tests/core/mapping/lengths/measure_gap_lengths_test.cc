// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/measure_gap_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/mapping/lengths/ask_gnss_of_ways.h"
#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/find_wall_shift.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/lengths/scale_jumps.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = TornStreet::kImages;

/// Everything from image 7 on stands farther along.
MappingState Torn(const TornStreet& street, double by_m) {
  MappingState torn = street.Right();
  for (ImageSlot image = 7; image < kImages; ++image)
    TornStreet::Move(image, {by_m, 0.0, 0.0}, torn);
  return torn;
}

TEST(GapLengths, AreOneForEachWayFromAnImageToTheNext) {
  const TornStreet street;
  const std::vector<GapLength> gaps = MeasureGapLengths({street.Right(), {}});
  ASSERT_EQ(gaps.size(), kImages - 1);
  for (uint32_t i = 0; i + 1 < kImages; ++i) {
    EXPECT_EQ(gaps[i].between, (ImagePair{ImageId(i), ImageId(i + 1)}));
    EXPECT_GE(gaps[i].pairs, 3U);
    EXPECT_GT(gaps[i].agreement.told, 100.0);
    EXPECT_GT(gaps[i].agreement.Share(), 0.8);
  }
}

TEST(GapLengths, DoNotDependOnTheFrameOfTheModel) {
  const TornStreet street;
  const MappingState torn = Torn(street, 3.0);
  const Sim3 other{0.3, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}};
  MappingState moved = street.Fixture().StateWith({});
  for (const ImageSlot image : torn.Registered())
    moved.Register(image, TransformCamera(other, torn.CamFromWorld(image)));
  const std::vector<GapLength> of_torn = MeasureGapLengths({torn, {}});
  const std::vector<GapLength> of_moved = MeasureGapLengths({moved, {}});
  ASSERT_EQ(of_moved.size(), of_torn.size());
  for (size_t i = 0; i < of_torn.size(); ++i) {
    EXPECT_DOUBLE_EQ(of_moved[i].agreement.told, of_torn[i].agreement.told);
    EXPECT_NEAR(of_moved[i].agreement.Share(), of_torn[i].agreement.Share(), 0.01);
    EXPECT_NEAR(of_moved[i].wall.Share(), of_torn[i].wall.Share(), 0.01);
    EXPECT_NEAR(of_moved[i].scale_jump, of_torn[i].scale_jump, 0.01);
  }
}

/// Pairs across a tear of half a step are all too long and bear each other out.
TEST(GapLengths, FindATearOfHalfAStep) {
  const TornStreet street;
  const double step_m = (TornStreet::Centre(7) - TornStreet::Centre(6)).norm();
  const std::vector<GapLength> gaps = MeasureGapLengths({Torn(street, 0.5 * step_m), {}});
  for (size_t i = 0; i < gaps.size(); ++i) {
    if (i == 6) {
      EXPECT_LT(gaps[i].agreement.Share(), 0.1);
    } else if (i + 1 < 6 || i > 7) {
      EXPECT_GT(gaps[i].agreement.Share(), 0.5) << i;
    } else {  // what lies on the side of the tear leads across it
      EXPECT_GT(gaps[i].agreement.Share(), gaps[6].agreement.Share()) << i;
    }
  }
}

/// A step that is a fifth too long still has every second ray within 15 % of it.
TEST(GapLengths, HearWhereRaysSayAnotherLength) {
  const TornStreet street;
  for (const GapLength& gap : MeasureGapLengths({street.Right(), {}})) {
    EXPECT_GT(gap.here, 20.0);
    EXPECT_FALSE(IsToldElsewhere(gap.here, gap.elsewhere)) << gap.between.a.value;
  }
  for (const double by_m : {-1.4, 1.4}) {
    const std::vector<GapLength> gaps = MeasureGapLengths({Torn(street, by_m), {}});
    EXPECT_TRUE(IsToldElsewhere(gaps[6].here, gaps[6].elsewhere)) << by_m;
    for (const size_t far : {0U, 1U, 2U, 10U, 11U, 12U, 13U})
      EXPECT_FALSE(IsToldElsewhere(gaps[far].here, gaps[far].elsewhere)) << far;
  }
}

/// Two right halves that stand askew: every length is right.
TEST(GapLengths, HearWhereMatchesSayThatTheTwoSidesStandAskew) {
  const TornStreet street;
  MappingState askew = street.Right();
  TornStreet::TurnFrom(7, 0.1, askew);
  const std::vector<GapLength> gaps = MeasureGapLengths({askew, {}});
  for (size_t i = 0; i < gaps.size(); ++i) {
    if (i + 3 > 6 && i < 6 + 3) continue;  // pairs that lead across image 6 and 7 lead across these
    EXPECT_GT(gaps[i].matches.Share(), 0.8) << i;
  }
  EXPECT_TRUE(IsAskew(gaps[6].matches)) << gaps[6].matches.Share();
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kHinge);
  EXPECT_EQ(faults[0].image, ImageId(6));
}

TEST(GapShift, IsByHowMuchTheStreetIsTorn) {
  const TornStreet street;
  for (const double by_m : {-3.0, 1.4, 4.0}) {
    const MappingState torn = Torn(street, by_m);
    const AskedRays asked(torn, {});
    const std::vector<GapVotes> gaps = CollectGapVotes(asked);
    for (const auto* votes : {&gaps[6].before, &gaps[6].behind}) {
      const GapShift shift = FindGapShift(asked, gaps[6], *votes);
      EXPECT_NEAR(shift.shift, -by_m, 0.15);
      EXPECT_GT(shift.elsewhere, 2.0 * shift.here);
    }
  }
}

/// All votes but every so manieth say anything from half the length to twice as much.
std::vector<LengthVote> Scattered(std::vector<LengthVote> votes, size_t every) {
  for (size_t i = 0; i < votes.size(); ++i) {
    const double share = std::fmod(0.618034 * static_cast<double>(i), 1.0);
    if (i % every != 0) votes[i].log_length += 1.4 * (share - 0.5);
  }
  return votes;
}

TEST(GapShift, IsHereWhereFewVotesCrowdAndTheOthersScatter) {
  const TornStreet street;
  const MappingState right = street.Right();
  const MappingState torn = Torn(street, 4.0);
  const AskedRays of_right(right, {});
  const AskedRays of_torn(torn, {});
  const GapVotes gap = CollectGapVotes(of_right)[6];
  const GapVotes torn_gap = CollectGapVotes(of_torn)[6];
  for (const size_t every : {1U, 3U, 5U}) {
    EXPECT_TRUE(FindGapShift(of_right, gap, Scattered(gap.before, every)).IsHere()) << every;
    const GapShift shift = FindGapShift(of_torn, torn_gap, Scattered(torn_gap.before, every));
    EXPECT_FALSE(shift.IsHere()) << every;
    EXPECT_GT(shift.rival, shift.here) << every;
  }
  EXPECT_FALSE(FindGapShift(of_right, gap, Scattered(gap.before, gap.before.size())).IsHere());
}

TEST(GapShift, IsNoneWhereNobodySaysAnything) {
  const TornStreet street;
  const MappingState right = street.Right();
  const AskedRays asked(right, {});
  const GapShift shift = FindGapShift(asked, {{.image = 3, .next = 4}}, {});
  EXPECT_EQ(shift.shift, 0.0);
  EXPECT_EQ(shift.here, 0.0);
  EXPECT_EQ(shift.elsewhere, 0.0);
}

TEST(GapShift, IsNoneWhereTwoPairsSayIt) {
  const TornStreet street;
  const MappingState torn = Torn(street, 4.0);
  const AskedRays asked(torn, {});
  const GapVotes gap = CollectGapVotes(asked)[6];
  std::vector<LengthVote> of_two = gap.before;
  std::set<uint32_t> pairs;
  for (const LengthVote& vote : of_two) pairs.insert(vote.pair);
  ASSERT_GT(pairs.size(), 2U);
  const uint32_t third = *std::next(pairs.begin(), 2);
  std::erase_if(of_two, [&](const LengthVote& vote) { return vote.pair >= third; });
  EXPECT_NE(FindGapShift(asked, gap, gap.before).shift, 0.0);
  EXPECT_EQ(FindGapShift(asked, gap, of_two).elsewhere, 0.0);
}

/// Two houses that are alike, and a step as long as they are wide: as if the camera had not moved.
TEST(GapLengths, AskMatchesOfNeighboursWhoseRaysHardlyMeet) {
  TornStreet street;
  MappingState state = street.Right();
  for (ImageSlot image = 0; image + 2 < kImages; ++image) state.Deregister(image);
  TornStreet::Move(kImages - 1, {-7.99, 0.0, 0.0}, state);
  street.Fool(kImages - 2, kImages - 1, state);
  const AskedRays asked(state, {});
  ASSERT_EQ(CollectGapVotes(asked).size(), 1U);
  EXPECT_LT(CollectGapVotes(asked)[0].asked, 10U);
  const GapLength length = MeasureGapLengths(asked)[0];
  EXPECT_GT(length.rays, 100U);
  EXPECT_EQ(length.telling_rays, 0U);
}

/// A panorama that one wall has 1.2 m too far along, of a street whose other wall knows better.
TEST(WallShift, IsWhatTheWallSaysThatIsNotFooled) {
  TornStreet street;
  MappingState wrong = street.Right();
  TornStreet::Move(7, {1.2, 0.0, 0.0}, wrong);
  street.FoolWall(7, wrong);
  const AskedRays asked(wrong, {});
  const GapVotes gap = CollectGapVotes(asked)[6];
  const GapShift wall = FindWallShift(asked, gap);
  EXPECT_TRUE(IsToldByWall(wall.here, wall.elsewhere)) << wall.here << " " << wall.elsewhere;
  EXPECT_NEAR(wall.shift, -1.2, 0.2);
  const auto walls = SplitByWalls(wrong, gap, gap.before);
  EXPECT_EQ(walls[0].size() + walls[1].size(), gap.before.size());
  EXPECT_GT(std::min(walls[0].size(), walls[1].size()), gap.before.size() / 4);
  const GapLength length = MeasureGapLengths(asked)[6];
  EXPECT_FALSE(length.is_borne_out);
  EXPECT_EQ(FindLengthFaults({}, {&length, 1}).size(), 1U);
}

TEST(WallShift, IsToldNowhereInARightModel) {
  const TornStreet street;
  const MappingState right = street.Right();
  const AskedRays asked(right, {});
  for (const GapVotes& gap : CollectGapVotes(asked)) {
    const GapShift wall = FindWallShift(asked, gap);
    EXPECT_FALSE(IsToldByWall(wall.here, wall.elsewhere)) << gap.image;
  }
}

/// The last three images and all that lies between them, twenty times too small.
TEST(ScaleJumps, AreWhereTheEndOfAStreetHasShrunk) {
  const TornStreet street;
  MappingState shrunk = street.Right();
  for (ImageSlot image = 12; image < kImages; ++image)
    TornStreet::Move(image, 0.95 * (TornStreet::Centre(11) - TornStreet::Centre(image)), shrunk);
  const auto jumps = MeasureScaleJumps({shrunk, {}});
  EXPECT_GT(jumps.at(11), std::log(10.0));
  for (const ImageSlot far : {1U, 3U, 5U, 7U}) EXPECT_LT(jumps.at(far), 0.3) << far;
  const std::vector<LengthFault> faults = FindLengthFaults(shrunk, MappingOptions{});
  EXPECT_TRUE(std::ranges::any_of(
      faults, [](const LengthFault& fault) { return fault.kind == LengthFaultKind::kScale; }));
  for (const auto& [image, jump] : MeasureScaleJumps({street.Right(), {}}))
    EXPECT_LT(jump, 0.3) << image;
}

TEST(ScaleJumps, AreNoneWhereACameraSlowsDown) {
  RayStreetOptions options{.points_per_metre = 60, .reach_m = 30.0, .window = 4};
  for (const double x_m : {0.0, 8.0, 16.0, 24.0, 32.0, 40.0, 40.8, 41.6, 42.4, 43.2, 44.0})
    options.centres.emplace_back(x_m, 0.0, 0.0);
  const StreetFixture street(options);
  const MappingState state = street.StateWith(FirstImages(11));
  for (const auto& [image, jump] : MeasureScaleJumps({state, {}}))
    EXPECT_LT(jump, std::log(2.0)) << image;
}

/// What is behind the jump agrees with itself.
TEST(GapLengths, FindWhereTheScaleJumps) {
  const TornStreet street;
  MappingState state = street.Right();
  for (ImageSlot image = 7; image < kImages; ++image)
    TornStreet::Move(image, 0.7 * (TornStreet::Centre(image) - TornStreet::Centre(6)), state);
  const std::vector<GapLength> gaps = MeasureGapLengths({state, {}});
  EXPECT_LT(gaps[6].agreement.Share(), 0.25);
  EXPECT_FALSE(gaps[6].is_borne_out);
  for (const size_t far : {0U, 1U, 2U, 3U, 10U, 11U, 12U, 13U})
    EXPECT_GT(gaps[far].agreement.Share(), 0.5) << far;
}

TEST(GapLengths, LeadOverImagesThatAreNotInTheModel) {
  const TornStreet street;
  MappingState state = street.Right();
  state.Deregister(7);
  const std::vector<GapLength> gaps = MeasureGapLengths({state, {}});
  ASSERT_EQ(gaps.size(), kImages - 2);
  EXPECT_EQ(gaps[6].between, (ImagePair{ImageId(6), ImageId(8)}));
  EXPECT_GT(gaps[6].agreement.Share(), 0.8);
}

/// Taken against the order of their names.
TEST(GapLengths, FollowTheDriveWhateverItsImagesAreCalled) {
  const TornStreet street;
  const MappingState torn = Torn(street, 3.0);
  ClusterProblem problem = street.Fixture().world.problem;
  for (ClusterImage& image : problem.images) image.rank_in_drive = kImages - image.id.value;
  MappingState state(problem, street.Fixture().graph);
  for (ImageSlot image = 0; image < kImages; ++image)
    state.Register(image, torn.CamFromWorld(image));
  const std::vector<GapLength> gaps = MeasureGapLengths({state, {}});
  ASSERT_EQ(gaps.size(), kImages - 1);
  EXPECT_EQ(gaps.front().between, (ImagePair{ImageId(kImages - 1), ImageId(kImages - 2)}));
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(7));
  EXPECT_EQ(faults[0].next, ImageId(6));
}

/// The street in a model, torn at image 7, its images of drives 0 and 1.
std::vector<GapLength> OfTwoDrives(const TornStreet& street, bool (*is_of_second)(uint32_t image)) {
  ClusterProblem problem = street.Fixture().world.problem;
  for (ClusterImage& image : problem.images) image.drive = is_of_second(image.id.value) ? 1 : 0;
  MappingState state(problem, street.Fixture().graph);
  const MappingState torn = Torn(street, 3.0);
  for (ImageSlot image = 0; image < kImages; ++image)
    state.Register(image, torn.CamFromWorld(image));
  return MeasureGapLengths({state, {}});
}

TEST(GapLengths, LeadFromOneDayToTheNext) {
  const std::vector<GapLength> gaps =
      OfTwoDrives(TornStreet(), [](uint32_t image) { return image >= 7; });
  ASSERT_EQ(gaps.size(), kImages - 1);
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(6));
  EXPECT_EQ(faults[0].next, ImageId(7));
}

TEST(GapLengths, EndWithTheLine) {
  const std::vector<GapLength> gaps =
      OfTwoDrives(TornStreet(), [](uint32_t image) { return image % 2 == 1; });
  ASSERT_EQ(gaps.size(), kImages - 2);
  EXPECT_EQ(gaps[7].between, (ImagePair{ImageId(1), ImageId(3)}));
}

TEST(GapLengths, ThereAreNoneOfNoModel) {
  const TornStreet street;
  EXPECT_TRUE(MeasureGapLengths({street.Fixture().StateWith({}), {}}).empty());
}

/// A street with positions that are off, and stated to so many metres.
struct MeasuredStreet {
  MeasuredStreet(double error_m, double sigma_m, double torn_by_m) {
    street.GivePositions(3, error_m, sigma_m);
    state.emplace(Torn(street, torn_by_m));
    asked.emplace(*state, MappingOptions{});
    gnss.emplace(*state, 4.0 * kMatchTolerance);
  }
  std::vector<GapLength> Gaps() const { return MeasureGapLengths(*asked, &*gnss); }

  TornStreet street{};
  std::optional<MappingState> state{};
  std::optional<AskedRays> asked{};
  std::optional<GnssWays> gnss{};
};

TEST(GapLengths, AreBorneOutByGnssThatKnowsThem) {
  const std::vector<GapLength> torn = MeasuredStreet(0.0, 0.5, 4.0).Gaps();
  for (size_t i = 0; i < torn.size(); ++i) EXPECT_EQ(torn[i].is_borne_out, i != 6) << i;
  const MeasuredStreet right(0.0, 0.5, 0.0);
  const MeasuredStreet badly_known(5.0, 5.0, 0.0);
  for (const GapVotes& gap : CollectGapVotes(*right.asked)) {
    EXPECT_TRUE(IsBorneOut(*right.asked, gap, *right.gnss, {}));
    EXPECT_FALSE(IsBorneOut(*badly_known.asked, gap, *badly_known.gnss, {}));
  }
}

TEST(GapLengths, AreBorneOutByRaysOfRightModels) {
  const TornStreet street;
  for (const GapLength& gap : MeasureGapLengths({street.Right(), {}}))
    EXPECT_TRUE(gap.is_borne_out) << gap.between.a.value;
  for (const double by_m : {-3.0, -1.4, 1.4, 4.0, 8.0})
    EXPECT_FALSE(MeasureGapLengths({Torn(street, by_m), {}})[6].is_borne_out) << by_m;
}

TEST(GapLengths, WhereRaysCrowdGnssNeedKnowThemButRoughly) {
  const MeasuredStreet street(2.0, 2.0, 0.0);
  const std::vector<GapVotes> gaps = CollectGapVotes(*street.asked);
  const auto count = [&](const WishOfRays& wish) {
    return std::ranges::count_if(gaps, [&](const GapVotes& gap) {
      return IsBorneOut(*street.asked, gap, *street.gnss, wish);
    });
  };
  EXPECT_GE(count({.here = 16.0}), std::ssize(gaps) / 2);
  EXPECT_LT(count({.here = 16.0}), std::ssize(gaps)) << "those that GNSS has otherwise";
  EXPECT_EQ(count({.here = 15.0}), 0);
  EXPECT_EQ(count({.here = 16.0, .elsewhere = 3.0}), 0) << "what GNSS does not refute";
  EXPECT_EQ(count({.here = 16.0, .elsewhere = 16.0}), count({.here = 16.0}));
}

TEST(GapLengths, CountTheRaysThatTell) {
  const TornStreet street;
  for (const GapLength& gap : MeasureGapLengths({street.Right(), {}})) {
    EXPECT_GT(gap.telling_rays, 100U);
    EXPECT_GT(gap.rays, gap.telling_rays);
  }
}

}  // namespace
}  // namespace orbweave
