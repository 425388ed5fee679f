// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/carry_on_by_gnss.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kImages = 40;
constexpr ImageSlot kBehind = 20;
constexpr double kStep_m = 6.0;

std::vector<Vector3d> Centres() {
  std::vector<Vector3d> centres;
  for (uint32_t i = 0; i < kImages; ++i) centres.emplace_back(kStep_m * i, 0.01 * i * i, 0.0);
  return centres;
}

/// A street with positions, across one way of which a single pair leads, unless all are to: nothing
/// but positions tells how long it is, and what lies behind.
class HungStreet {
 public:
  explicit HungStreet(bool with_all_pairs = false)
      : street_({.centres = Centres(),
                 .points_per_metre = 8,
                 .reach_m = 25.0,
                 .window = 3,
                 .outlier_share = 0.1,
                 .random_rotations = true}) {
    ClusterProblem& problem = street_.world.problem;
    std::erase_if(problem.pairs, [&](const TwoViewGeometry& pair) {
      const bool leads_across = pair.pair.a.value < kBehind && pair.pair.b.value >= kBehind;
      return !with_all_pairs && leads_across && pair.pair.b.value - pair.pair.a.value > 1;
    });
    street_.graph = BuildCorrespondenceGraph(problem).value();
    Random random(3);
    for (uint32_t i = 0; i < kImages; ++i) {
      ClusterImage& image = problem.images[i];
      image.rank_in_drive = i;
      image.prior.position_in_enu =
          Centres()[i] + 1.5 * Vector3d(random.Normal(), random.Normal(), 0.0);
      image.prior.horizontal_sigma_m = image.prior.vertical_sigma_m = 1.5;
    }
  }

  void ShiftPositions(ImageSlot first, ImageSlot last, double metres) {
    for (ImageSlot image = first; image <= last; ++image)
      street_.world.problem.images[image].prior.position_in_enu->x() += metres;
  }

  /// All behind the way so many times as large, and so much further on.
  [[nodiscard]] MappingState With(double scale, double further_m) const {
    MappingState state = street_.StateWith(FirstImages(kImages));
    const Vector3d pivot = state.Centre(kBehind - 1);
    for (ImageSlot image = kBehind; image < kImages; ++image) {
      const Rigid3 pose = state.CamFromWorld(image);
      const Vector3d centre =
          pivot + scale * (pose.Centre() - pivot) + Vector3d(further_m, 0.0, 0.0);
      state.SetPose(image, Rigid3::FromCentre(pose.rotation, centre));
    }
    for (ImageSlot image = 0; image < kImages; ++image)
      TriangulateImage(state, image, TrackLimits{});
    return state;
  }

 private:
  StreetFixture street_;
};

double WorstError(const MappingState& state) {
  double worst_m = 0.0;
  for (ImageSlot image = 0; image < kImages; ++image)
    worst_m = std::max(worst_m, (state.Centre(image) - Centres()[image]).norm());
  return worst_m;
}

TEST(CarryOnByGnss, PutsWhatLiesBehindAWayOnItsScaleAndToItsPlace) {
  const HungStreet street;
  struct Wrong {
    double scale;
    double further_m;
  };
  for (const auto& [scale, further_m] : {Wrong{1.3, 0.0}, Wrong{1.0, 12.0}, Wrong{0.75, 0.0}}) {
    MappingState state = street.With(scale, further_m);
    EXPECT_GT(WorstError(state), 11.0);
    const auto was_taken = CarryOnByGnss(state, {}, {});
    ASSERT_TRUE(was_taken.ok()) << was_taken.status();
    EXPECT_TRUE(*was_taken) << scale;
    EXPECT_LT(WorstError(state), 4.0) << scale;
  }
}

TEST(CarryOnByGnss, LeavesARightModelAsItIs) {
  const HungStreet street;
  MappingState state = street.With(1.0, 0.0);
  EXPECT_FALSE(CarryOnByGnss(state, {}, {}).value());
  EXPECT_LT(WorstError(state), 1e-6);
}

TEST(CarryOnByGnss, LeavesARightModelToAReceiverThatJumps) {
  for (const double metres : {-15.0, 15.0, 60.0}) {
    HungStreet street;
    street.ShiftPositions(24, 30, metres);
    MappingState state = street.With(1.0, 0.0);
    EXPECT_FALSE(CarryOnByGnss(state, {}, {}).value()) << metres;
    EXPECT_LT(WorstError(state), 1e-6) << metres;
  }
}

TEST(CarryOnByGnss, LeavesARightModelThatPointsHoldToPositionsThatAreElsewhereFromAWayOn) {
  for (const double metres : {-9.0, 9.0, 20.0}) {
    HungStreet street(true);
    street.ShiftPositions(kBehind, kImages - 1, metres);
    MappingState state = street.With(1.0, 0.0);
    EXPECT_FALSE(CarryOnByGnss(state, {}, {}).value()) << metres;
    EXPECT_LT(WorstError(state), 1e-6) << metres;
  }
}

TEST(CarryOnByGnss, EndsWhenAskedTo) {
  const HungStreet street;
  MappingState state = street.With(1.3, 0.0);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(CarryOnByGnss(state, {}, {.stop = stop.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
