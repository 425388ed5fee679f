// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/ready_parts.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"

namespace orbweave {
namespace {

TEST(ReadyParts, IsASetOfNumbers) {
  Random random(1);
  ReadyParts parts;
  std::set<uint32_t> same;
  for (int step = 0; step < 5000; ++step) {
    const uint32_t part = random.Index(40);
    if (random.Index(2) == 0) {
      parts.Insert(part);
      same.insert(part);
    } else {
      EXPECT_EQ(parts.Erase(part), same.erase(part) == 1);
    }
    std::set<uint32_t> listed;
    EXPECT_FALSE(parts.FindFirst([&listed](uint32_t each) {
      listed.insert(each);
      return false;
    }));
    ASSERT_EQ(listed, same);
    ASSERT_EQ(parts.empty(), same.empty());
    ASSERT_EQ(parts.Contains(part), same.contains(part));
  }
}

TEST(ReadyParts, KnowsTheFirstOfItsLongestStretches) {
  ReadyParts parts;
  EXPECT_EQ(parts.Longest().size(), 0U);
  for (const uint32_t part : {3U, 0U, 1U, 7U, 8U, 4U}) parts.Insert(part);
  EXPECT_EQ(parts.Longest().first, 0U);
  EXPECT_EQ(parts.Longest().end, 2U);
  parts.Insert(2);  // joins 0 1 and 3 4
  EXPECT_EQ(parts.Longest().size(), 5U);
  EXPECT_TRUE(parts.Erase(1));
  EXPECT_EQ(parts.Longest().first, 2U);
  EXPECT_EQ(parts.FindFirst([](uint32_t part) { return part > 4; }), 7U);
}

}  // namespace
}  // namespace orbweave
