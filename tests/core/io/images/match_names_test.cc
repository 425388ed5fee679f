// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/match_names.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(MatchNames, PrefersTheFullNameThenBaseNameThenStem) {
  EXPECT_THAT(
      MatchNames({"a/1.jpg", "a/2.jpg", "a/3.jpg", "a/4.jpg"}, {"3", "X/a/2.JPG", "A/1.JPG"}),
      ElementsAre(Optional(2U), Optional(1U), Optional(0U), std::nullopt));
}

TEST(MatchNames, DoesNotGuessBetweenEqualNames) {
  EXPECT_THAT(MatchNames({"a/1.jpg", "b/1.jpg"}, {"1.jpg"}),
              ElementsAre(std::nullopt, std::nullopt));
  EXPECT_THAT(MatchNames({"a/1.jpg"}, {"x/1.jpg", "y/1.jpg"}), ElementsAre(std::nullopt));
  // The full name takes the one, which leaves the other alone.
  EXPECT_THAT(MatchNames({"a/1.jpg", "b/1.jpg"}, {"a/1.jpg", "1.jpg"}),
              ElementsAre(Optional(0U), Optional(1U)));
}

}  // namespace
}  // namespace orbweave
