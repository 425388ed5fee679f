// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/measure_pair_lengths.h"

#include <gtest/gtest.h>

#include "core/geometry/sim3.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = TornStreet::kImages;

/// What the pairs of each image say together.
std::vector<LengthAgreement> Measure(const MappingState& state) {
  std::vector<LengthAgreement> of_image(kImages);
  for (const PairLength& pair : MeasurePairLengths({state, {}})) {
    of_image[pair.pair.a.value].Add(pair.agreement);
    of_image[pair.pair.b.value].Add(pair.agreement);
  }
  return of_image;
}

TEST(PairLengths, IsNearlyWholeWhereTheModelIsRight) {
  const TornStreet street;
  const MappingState state = street.Right();
  for (const LengthAgreement& image : Measure(state)) {
    EXPECT_GT(image.told, 100.0);
    EXPECT_GT(image.Share(), 0.8);
  }
  EXPECT_TRUE(FindLengthFaults(state, {}).empty());
}

TEST(PairLengths, DoesNotDependOnTheFrameOfTheModel) {
  const TornStreet street;
  const MappingState state = street.Right();
  const Sim3 other{0.3, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}};
  MappingState moved = street.Fixture().StateWith({});
  for (const ImageSlot image : state.Registered())
    moved.Register(image, TransformCamera(other, state.CamFromWorld(image)));
  for (ImageSlot image = 0; image < kImages; ++image) {
    EXPECT_DOUBLE_EQ(Measure(moved)[image].told, Measure(state)[image].told);
    EXPECT_NEAR(Measure(moved)[image].Share(), Measure(state)[image].Share(), 0.01);
  }
}

TEST(PairLengths, FindsAnImageAHouseTooFarAlong) {
  const TornStreet street;
  const MappingState right = street.Right();
  MappingState state = street.Right();
  TornStreet::Move(
      7, TornStreet::Centre(8) - TornStreet::Centre(7) - Eigen::Vector3d(0.5, 0.0, 0.0), state);
  const std::vector<LengthAgreement> measured = Measure(state);
  EXPECT_LT(measured[7].Share(), 0.2);
  for (const ImageSlot image : {0U, 2U, 12U, 14U}) EXPECT_GT(measured[image].Share(), 0.8);
  const std::vector<LengthFault> faults = FindLengthFaults(state, {});
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].image, ImageId(7));
  EXPECT_FALSE(faults[0].next);
  EXPECT_GT(CountAgreeingRays(right, {}), 1.1 * CountAgreeingRays(state, {}));
}

/// Tracks that jump outnumber the right ones between two neighbours: their pair says half a step,
/// and the model has it so.
TEST(PairLengths, IsNotFooledByOnePairThatTheModelFollows) {
  TornStreet street;
  MappingState state = street.Right();
  TornStreet::Move(7, 0.55 * (TornStreet::Centre(6) - TornStreet::Centre(7)), state);
  street.Fool(6, 7, state);
  const std::vector<LengthAgreement> measured = Measure(state);
  EXPECT_LT(measured[7].Share(), 0.35);
  for (const ImageSlot image : {0U, 2U, 12U, 14U}) EXPECT_GT(measured[image].Share(), 0.8);
  const MappingState right = street.Right();
  EXPECT_GT(CountAgreeingRays(right, {}), CountAgreeingRays(state, {}));
}

TEST(PairLengths, FindsWhereAStreetIsTorn) {
  const TornStreet street;
  const MappingState right = street.Right();
  MappingState torn = street.Right();
  for (ImageSlot image = 7; image < kImages; ++image)
    TornStreet::Move(image, {6.0, 0.0, 0.0}, torn);
  const std::vector<LengthFault> faults = FindLengthFaults(torn, {});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(6));
  EXPECT_EQ(faults[0].next, ImageId(7));
  EXPECT_LT(CountAgreeingRays(torn, {}), 0.9 * CountAgreeingRays(right, {}));
}

TEST(PairLengths, OfAFoldedModelIsThatOfThePairsThatAreLeft) {
  const TornStreet street;
  const MappingState right = street.Right();
  MappingState folded = street.Right();
  for (ImageSlot image = 8; image < kImages; ++image)
    TornStreet::Move(image, 2.0 * (TornStreet::Centre(7) - TornStreet::Centre(image)), folded);
  EXPECT_LT(CountAgreeingRays(folded, {}), 0.7 * CountAgreeingRays(right, {}));
}

TEST(PairLengths, NothingIsToldWithoutSharedRays) {
  const TornStreet street;
  EXPECT_EQ(Measure(street.Fixture().StateWith(FirstImages(2)))[0].told, 0.0);
  EXPECT_TRUE(MeasurePairLengths({street.Fixture().StateWith({}), {}}).empty());
}

TEST(PairLengths, ACameraThatStandsTellsNothing) {
  const StreetFixture street({.centres = std::vector<Eigen::Vector3d>(6, {1.0, 2.0, 3.0}),
                              .points_per_metre = 8,
                              .reach_m = 30.0,
                              .window = 4});
  EXPECT_TRUE(FindLengthFaults(street.StateWith(FirstImages(6)), {}).empty());
}

}  // namespace
}  // namespace orbweave
