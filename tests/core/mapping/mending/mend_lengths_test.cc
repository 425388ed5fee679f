// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/mend_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mapping/checks/compare_models.h"
#include "core/mapping/lengths/centre_by_lengths.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = TornStreet::kImages;

MappingState WithPoints(MappingState state) {
  for (ImageSlot image = 0; image < kImages; ++image) TriangulateImage(state, image, TrackLimits{});
  return state;
}

/// With the image nearly where the next one stands.
MappingState WithOneTooFar(const TornStreet& street, ImageSlot image) {
  MappingState state = street.Right();
  TornStreet::Move(image, {7.0, 0.0, 0.0}, state);
  return state;
}

double ErrorOf(const MappingState& state, ImageSlot image) {
  return (state.Centre(image) - TornStreet::Centre(image)).norm();
}

TEST(CentreByLengths, IsWhereTheRaysOfTheOthersPutTheImage) {
  const TornStreet street;
  const auto centre = CentreByLengths(WithOneTooFar(street, 7), 7, {});
  ASSERT_TRUE(centre);
  EXPECT_LT((*centre - TornStreet::Centre(7)).norm(), 1.0);
}

TEST(CentreByLengths, IsNotFooledByTheStrongestPair) {
  TornStreet street;
  const MappingState wrong = WithOneTooFar(street, 7);
  street.Fool(6, 7, wrong);
  const auto centre = CentreByLengths(wrong, 7, {});
  ASSERT_TRUE(centre);
  EXPECT_LT((*centre - TornStreet::Centre(7)).norm(), 1.0);
}

TEST(CentreByLengths, IsNoneForAnImageThatStandsRight) {
  const TornStreet street;
  for (ImageSlot image = 0; image < kImages; ++image)
    EXPECT_FALSE(CentreByLengths(street.Right(), image, {})) << image;
}

TEST(CentreByLengths, IsNoneWhereFewPairsSay) {
  const TornStreet street;
  MappingState three = street.Fixture().StateWith(FirstImages(3));
  TornStreet::Move(2, {6.0, 0.0, 0.0}, three);
  EXPECT_FALSE(CentreByLengths(three, 2, {}));
}

TEST(MendLengths, PutsOneImageBack) {
  const TornStreet street;
  MappingState state = WithPoints(WithOneTooFar(street, 7));
  const auto is_mended = MendLengths(state, {}, {});
  ASSERT_TRUE(is_mended.ok()) << is_mended.status();
  EXPECT_TRUE(*is_mended);
  for (ImageSlot image = 0; image < kImages; ++image)
    EXPECT_LT(ErrorOf(state, image), 0.5) << image;
}

/// Everything behind image 6 moved by what `by` says of it.
template <typename Displacement>
MappingState WithTheRestMoved(const TornStreet& street, const Displacement& by) {
  MappingState state = street.Right();
  for (ImageSlot image = 7; image < kImages; ++image) TornStreet::Move(image, by(image), state);
  return state;
}

/// After one similarity, as the scale of a whole model is free.
double WorstStepError(const MappingState& state) {
  const double unit = (state.Centre(1) - state.Centre(0)).norm() /
                      (TornStreet::Centre(1) - TornStreet::Centre(0)).norm();
  double worst_m = 0.0;
  for (ImageSlot image = 0; image + 1 < kImages; ++image) {
    const double step = (state.Centre(image + 1) - state.Centre(image)).norm() / unit;
    const double truth_m = (TornStreet::Centre(image + 1) - TornStreet::Centre(image)).norm();
    worst_m = std::max(worst_m, std::abs(step - truth_m));
  }
  return worst_m;
}

TEST(MendLengths, PutsEverythingBehindATearBack) {
  const TornStreet street;
  for (const double by_m : {-2.5, 1.6, 4.0, 7.0}) {
    MappingState state = WithPoints(
        WithTheRestMoved(street, [&](ImageSlot) { return Eigen::Vector3d(by_m, 0.0, 0.0); }));
    EXPECT_TRUE(MendLengths(state, {}, {}).value()) << by_m;
    EXPECT_LT(WorstStepError(state), 0.3) << by_m;
  }
}

TEST(MendLengths, PutsAPieceBack) {
  const TornStreet street;
  MappingState state = WithPoints(WithTheRestMoved(
      street, [](ImageSlot image) { return Eigen::Vector3d(image < 10 ? 4.0 : 0.0, 0.0, 0.0); }));
  EXPECT_TRUE(MendLengths(state, {}, {}).value());
  EXPECT_LT(WorstStepError(state), 0.3);
}

TEST(MendLengths, PutsWhatIsOnAnotherScaleOnThatOfTheRest) {
  const TornStreet street;
  MappingState state = WithPoints(WithTheRestMoved(street, [](ImageSlot image) {
    return Eigen::Vector3d(0.3 * (TornStreet::Centre(image) - TornStreet::Centre(6)));
  }));
  EXPECT_TRUE(MendLengths(state, {}, {}).value());
  EXPECT_LT(WorstStepError(state), 0.3);
}

/// Of the directions of steps, as the image before each sees them.
double WorstTurn(const MappingState& state) {
  const MappingState right = TornStreet().Right();
  double worst_rad = 0.0;
  for (ImageSlot image = 0; image + 1 < kImages; ++image) {
    const auto seen = [&](const MappingState& of) {
      return Eigen::Vector3d(of.CamFromWorld(image) * of.Centre(image + 1)).normalized();
    };
    worst_rad = std::max(worst_rad, std::acos(std::min(1.0, seen(state).dot(seen(right)))));
  }
  return worst_rad;
}

TEST(MendLengths, TurnsBackWhatStandsAskew) {
  const TornStreet street;
  MappingState state = street.Right();
  TornStreet::TurnFrom(7, 0.14, state);
  state = WithPoints(state);
  EXPECT_GT(WorstTurn(state), 0.1);
  EXPECT_TRUE(MendLengths(state, {}, {}).value());
  EXPECT_LT(WorstTurn(state), 0.01);
  EXPECT_LT(WorstStepError(state), 0.3);
}

/// Every third image is of another drive; what is torn is the first one, with what belongs to it.
TEST(MendLengths, TakesWhatGoesWithThePieceOfOtherDrivesAlong) {
  const TornStreet street;
  ClusterProblem problem = street.Fixture().world.problem;
  for (ClusterImage& image : problem.images) image.drive = image.id.value % 3 == 1 ? 1 : 0;
  MappingState state(problem, street.Fixture().graph);
  const MappingState torn =
      WithTheRestMoved(street, [](ImageSlot) { return Eigen::Vector3d(5.0, 0.0, 0.0); });
  for (ImageSlot image = 0; image < kImages; ++image)
    state.Register(image, torn.CamFromWorld(image));
  state = WithPoints(state);
  EXPECT_TRUE(MendLengths(state, {}, {}).value());
  EXPECT_LT(WorstStepError(state), 0.3);
}

TEST(MendLengths, LeavesARightModelAsItIs) {
  const TornStreet street;
  MappingState state = WithPoints(street.Right());
  const MappingState before = state;
  EXPECT_FALSE(MendLengths(state, {}, {}).value());
  for (ImageSlot image = 0; image < kImages; ++image)
    EXPECT_EQ(state.Centre(image), before.Centre(image));
  EXPECT_EQ(state.NumObservations(), before.NumObservations());
}

TEST(MendLengths, EndsWhenAskedTo) {
  const TornStreet street;
  MappingState state = WithPoints(WithOneTooFar(street, 7));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(MendLengths(state, {}, {.stop = stop.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

TEST(EvidenceFor, IsMoreForTheRightModel) {
  const TornStreet street;
  EXPECT_GT(EvidenceFor(WithPoints(street.Right()), {}),
            1.1 * EvidenceFor(WithPoints(WithOneTooFar(street, 7)), {}));
}

}  // namespace
}  // namespace orbweave
