// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/slide_onto_gnss.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/lengths/measure_pair_lengths.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = TornStreet::kImages;
constexpr ImageSlot kFirst = 6;
constexpr ImageSlot kLast = 7;

/// A street with positions of half a metre, of which two panoramas may stand most of a step too far
/// along, and their pairs with all others be fooled.
class FooledStreet {
 public:
  FooledStreet() { street_.GivePositions(5, 0.5, 0.5); }

  /// Their pairs with the nearest others have more wrong matches than right ones, which say so.
  void Fool() {
    const MappingState wrong = Wrong(false);
    for (const ImageSlot inside : {kFirst, kLast}) {
      for (const ImageSlot outside : {kFirst - 1, kLast + 1})
        street_.Fool(std::min(inside, outside), std::max(inside, outside), wrong);
    }
  }
  void ShiftPositions(ImageSlot first, ImageSlot last, double metres) {
    for (ImageSlot image = first; image <= last; ++image) {
      *street_.Fixture().world.problem.images[image].prior.position_in_enu +=
          Eigen::Vector3d(metres, 0.0, 0.0);
    }
  }
  [[nodiscard]] MappingState Right() const { return WithPoints(street_.Right()); }
  [[nodiscard]] MappingState Wrong(bool with_points = true) const {
    MappingState state = street_.Right();
    for (ImageSlot image = kFirst; image <= kLast; ++image)
      TornStreet::Move(image, {7.0, 0.0, 0.0}, state);
    return with_points ? WithPoints(std::move(state)) : state;
  }

 private:
  static MappingState WithPoints(MappingState state) {
    for (ImageSlot image = 0; image < kImages; ++image)
      TriangulateImage(state, image, TrackLimits{});
    return state;
  }

  TornStreet street_;
};

double WorstError(const MappingState& state) {
  double worst_m = 0.0;
  for (ImageSlot image = 0; image < kImages; ++image)
    worst_m = std::max(worst_m, (state.Centre(image) - TornStreet::Centre(image)).norm());
  return worst_m;
}

TEST(SlideOntoGnss, PutsAPieceBackThatAgreesWithItself) {
  FooledStreet street;
  street.Fool();
  MappingState state = street.Wrong();
  EXPECT_GT(WorstError(state), 6.0);
  const auto has_slid = SlideOntoGnss(state, {}, {});
  ASSERT_TRUE(has_slid.ok()) << has_slid.status();
  EXPECT_TRUE(*has_slid);
  EXPECT_LT(WorstError(state), 0.5);
}

TEST(SlideOntoGnss, LeavesARightModelToPositionsThatAreWrong) {
  for (const double metres : {-7.0, 7.0, 30.0}) {
    FooledStreet street;
    street.ShiftPositions(kFirst, kLast, metres);
    MappingState state = street.Right();
    EXPECT_FALSE(SlideOntoGnss(state, {}, {}).value()) << metres;
    EXPECT_LT(WorstError(state), 1e-6) << metres;
  }
}

TEST(SlideOntoGnss, LeavesARightModelAsItIs) {
  const FooledStreet street;
  MappingState state = street.Right();
  EXPECT_FALSE(SlideOntoGnss(state, {}, {}).value());
  EXPECT_LT(WorstError(state), 1e-6);
}

TEST(SlideOntoGnss, EndsWhenAskedTo) {
  FooledStreet street;
  street.Fool();
  MappingState state = street.Wrong();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(SlideOntoGnss(state, {}, {.stop = stop.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
