// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mend_lengths.h"

#include <gtest/gtest.h>

#include "core/mapping/centre_by_lengths.h"
#include "core/mapping/compare_models.h"
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
  const auto moved = MendLengths(state, {}, {});
  ASSERT_TRUE(moved.ok()) << moved.status();
  EXPECT_EQ(*moved, 1);
  for (ImageSlot image = 0; image < kImages; ++image)
    EXPECT_LT(ErrorOf(state, image), 0.5) << image;
}

TEST(MendLengths, LeavesARightModelAsItIs) {
  const TornStreet street;
  MappingState state = WithPoints(street.Right());
  const MappingState before = state;
  EXPECT_EQ(MendLengths(state, {}, {}).value(), 0);
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
