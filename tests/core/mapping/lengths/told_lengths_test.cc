// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/told_lengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/random.h"
#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "tests/core/mapping/torn_street.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Lengths of which some crowd and others lie anywhere between 0.2 and 5.
ToldLengths RandomLengths(Random& random) {
  std::vector<double> log_lengths;
  const double crowd = random.Uniform(-1.0, 1.0);
  const int count = 1 + static_cast<int>(random.Uniform(0.0, 120.0));
  for (int i = 0; i < count; ++i) {
    log_lengths.push_back(i % 3 == 0 ? random.Uniform(std::log(0.2), std::log(5.0))
                                     : crowd + 0.03 * random.Normal());
  }
  return {Vector3d::UnitX(), log_lengths};
}

TEST(ToldLengths, NoLengthHasMoreThanMostWithinItsBounds) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const ToldLengths told = RandomLengths(random);
    const double one = random.Uniform(0.1, 4.0);
    const double other = random.Uniform(0.1, 4.0);
    const auto [shortest, longest] = std::minmax(one, other);
    const double most = told.MostWithin(shortest, longest);
    for (int i = 0; i < 20; ++i) {
      const double length = random.Uniform(shortest, longest);
      EXPECT_LE(told.CountAgreeing(length * Vector3d::UnitX()), most);
    }
    const std::optional<double> mode = told.ModeWithin(shortest, longest);
    if (!mode) continue;
    EXPECT_GT(told.CountAgreeing(*mode * Vector3d::UnitX()), 0.0);
  }
}

TEST(ToldLengths, NearAreThoseThatAgreeClosely) {
  const double close = std::exp(0.9 * kCloseTolerance);
  const double apart = std::exp(1.1 * kCloseTolerance);
  const ToldLengths told(
      Vector3d::UnitX(),
      {std::log(2.0 * apart), std::log(2.0), std::log(2.0 * close), std::log(2.0 / apart)});
  EXPECT_THAT(told.Near(2.0),
              testing::ElementsAre(testing::DoubleNear(2.0, 1e-12),
                                   testing::DoubleNear(2.0 * close, 1e-12)));
  EXPECT_THAT(told.Near(9.0), testing::IsEmpty());
  EXPECT_EQ(told.MostWithin(8.0, 9.0), 0.0);
}

/// What is looked for only where it may be wanted is what is found when it is always looked for.
TEST(GapShiftWithin, IsTheSameWhereItIsWanted) {
  const TornStreet street;
  for (const double torn_m : {0.0, 0.5, 1.5}) {
    MappingState state = street.Right();
    for (ImageSlot image = 7; image < TornStreet::kImages; ++image)
      TornStreet::Move(image, {torn_m, 0.0, 0.0}, state);
    const AskedRays asked(state, {});
    const GapVotes gap = CollectGapVotes(asked)[6];
    constexpr double kWanted = 1.5;
    const GapShift always = FindGapShiftWithin(asked, gap, gap.before, -3.0, 3.0);
    const GapShift wanted = FindGapShiftWithin(asked, gap, gap.before, -3.0, 3.0, kWanted);
    EXPECT_EQ(wanted.here, always.here);
    const bool is_wanted = DeviationsElsewhere(always.here, always.elsewhere) > kWanted;
    EXPECT_EQ(is_wanted, torn_m > 1.0);
    EXPECT_EQ(wanted.elsewhere, is_wanted ? always.elsewhere : 0.0);
    EXPECT_EQ(wanted.shift, is_wanted ? always.shift : 0.0);
    EXPECT_NEAR(always.shift, -torn_m, 0.1);
  }
}

}  // namespace
}  // namespace orbweave
