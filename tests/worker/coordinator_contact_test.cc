// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/coordinator_contact.h"

#include <gtest/gtest.h>

#include <limits>

namespace orbweave {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(CoordinatorContact, IsGivenUpAfterAsLongWithoutAnAnswer) {
  CoordinatorContact contact(10.0, kNever, 100.0);
  EXPECT_FALSE(contact.IsGivenUp(109.9));
  EXPECT_TRUE(contact.IsGivenUp(110.0)) << "it was never there";
  contact.Heard(false, 105.0);
  contact.NotHeard();
  EXPECT_FALSE(contact.IsGivenUp(114.9));
  EXPECT_TRUE(contact.IsGivenUp(115.0));
}

TEST(CoordinatorContact, IdleIsWhoHadNothingToDoThoughItAsked) {
  CoordinatorContact contact(kNever, 10.0, 0.0);
  contact.Heard(false, 100.0);
  EXPECT_EQ(contact.UntilIdle(100.0), 10.0) << "it could not ask before";
  contact.Heard(false, 105.0);
  EXPECT_EQ(contact.UntilIdle(105.0), 5.0);
  contact.Heard(true, 106.0);
  EXPECT_EQ(contact.UntilIdle(106.0), 10.0);
  contact.Worked(107.0);
  EXPECT_EQ(contact.UntilIdle(108.0), 9.0);
  contact.NotHeard();
  contact.Heard(false, 130.0);
  EXPECT_EQ(contact.UntilIdle(130.0), 10.0) << "nobody was there who could have had something";
}

TEST(CoordinatorContact, IsWaitedForWithoutEndUnlessItIsSaid) {
  CoordinatorContact contact(kNever, kNever, 0.0);
  contact.Heard(false, 0.0);
  EXPECT_FALSE(contact.IsGivenUp(1e12));
  EXPECT_GT(contact.UntilIdle(1e12), 0.0);
}

}  // namespace
}  // namespace orbweave
