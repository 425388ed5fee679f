// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/gnss_ways.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/lengths/matches_in_planes.h"
#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

constexpr uint32_t kImages = GnssWalk::kImages;

MappingState StateOf(const GnssWalk& walk) { return walk.StateWithout(kImages); }

/// Ways that are further off are looked at (ListSlides).
constexpr double kListed = 2.0;

GnssWays WaysOf(const MappingState& state) { return {state, 4.0 * kMatchTolerance}; }

/// Images from `first` to `last` as many metres further along.
void Slide(ImageSlot first, ImageSlot last, double metres, const GnssWalk& walk, MappingState& to) {
  for (ImageSlot image = first; image <= last; ++image)
    to.SetPose(image, walk.Further(image, metres));
}

TEST(GnssWays, LeadToTheNextAndTheNextButOne) {
  const GnssWalk walk;
  const GnssWays gnss = WaysOf(StateOf(walk));
  EXPECT_EQ(gnss.Ways().size(), 2 * kImages - 3);
  EXPECT_EQ(std::ranges::count_if(gnss.Ways(), &GnssWay::leads_to_next), kImages - 1);
}

TEST(GnssWays, AreRightInARightModelWhateverItsFrame) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    GnssWalk walk(seed);
    const MappingState state = StateOf(walk);
    const double misfit = WaysOf(state).Misfit(state);
    EXPECT_LT(misfit, 2.5 * (2 * kImages - 3)) << "seed " << seed;
    walk.model_from_world = {7.0, RotationFromVector({-2.0, 0.3, 1.0}), {40.0, 2.0, -9.0}};
    const MappingState elsewhere = StateOf(walk);
    EXPECT_NEAR(WaysOf(elsewhere).Misfit(elsewhere), misfit, 1e-6) << "seed " << seed;
  }
}

TEST(GnssWays, AreOffAtBothEndsOfAPieceThatStandsAHouseTooFar) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const GnssWalk walk(seed);
    const MappingState right = StateOf(walk);
    MappingState wrong = right;
    Slide(6, 7, 7.0, walk, wrong);
    const GnssWays gnss = WaysOf(wrong);
    EXPECT_GT(gnss.Misfit(wrong), gnss.Misfit(right) + 30.0) << "seed " << seed;
    for (const GnssWay& way : gnss.Ways()) {
      if (!way.leads_to_next) continue;
      const double misfit = way.Misfit(wrong);
      if (way.image == 5) {
        EXPECT_GT(misfit, kListed) << "seed " << seed;
      } else if (way.image == 7) {
        EXPECT_LT(misfit, -kListed) << "seed " << seed;
      } else {
        EXPECT_LT(std::abs(misfit), 3.0) << "seed " << seed;
      }
    }
  }
}

TEST(GnssWays, APositionThatIsFarOffSpeaksNoLouder) {
  GnssWalk walk;
  const MappingState right = StateOf(walk);
  const double before = WaysOf(right).Misfit(right);
  *walk.Prior(6).position_in_enu += Eigen::Vector3d(4000.0, 0.0, 0.0);
  const MappingState state = StateOf(walk);
  EXPECT_LE(WaysOf(state).Misfit(state), before + 4 * 25.0 + 10.0);
}

TEST(GnssWays, AreNoneWithoutPositions) {
  GnssWalk walk;
  for (uint32_t image = 0; image < kImages; ++image) walk.Prior(image).position_in_enu.reset();
  const MappingState state = StateOf(walk);
  EXPECT_TRUE(WaysOf(state).Ways().empty());
  EXPECT_EQ(WaysOf(state).Misfit(state), 0.0);
}

}  // namespace
}  // namespace orbweave
