// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/strong_id.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <unordered_set>

namespace orbweave {
namespace {

using AppleId = StrongId<struct AppleTag>;
using PearId = StrongId<struct PearTag>;

static_assert(!std::is_convertible_v<AppleId, PearId>);
static_assert(!std::is_convertible_v<uint32_t, AppleId>);

TEST(StrongId, IsInvalidUntilItHasAValue) {
  EXPECT_FALSE(AppleId().IsValid());
  EXPECT_TRUE(AppleId(0).IsValid());
}

TEST(StrongId, IsOrderedAndHashedByValue) {
  EXPECT_LT(AppleId(1), AppleId(2));
  EXPECT_EQ(AppleId(3), AppleId(3));
  const std::unordered_set<AppleId> apples = {AppleId(1), AppleId(2), AppleId(1)};
  EXPECT_EQ(apples.size(), 2U);
}

}  // namespace
}  // namespace orbweave
