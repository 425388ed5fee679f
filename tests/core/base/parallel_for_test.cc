// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace orbweave {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const int num_threads : {-1, 0, 1, 2, 7, 300}) {
    std::vector<int> calls(100, 0);
    ParallelFor(calls.size(), num_threads, [&](size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << num_threads;
  }
}

TEST(ParallelFor, DoesNothingForNothing) {
  ParallelFor(0, 4, [](size_t) { FAIL(); });
}

TEST(ParallelFor, RethrowsTheFailureOfTheSmallestIndex) {
  for (const int num_threads : {1, 4}) {
    try {
      ParallelFor(50, num_threads, [](size_t i) {
        if (i == 7 || i == 31) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(ParallelFor, EndsAllThreadsBeforeItThrows) {
  std::atomic<int> running{0};
  const auto body = [&](size_t i) {
    ++running;
    const bool fails = i % 5 == 0;
    --running;
    if (fails) throw std::runtime_error("fifth");
  };
  EXPECT_THROW(ParallelFor(100, 4, body), std::runtime_error);
  EXPECT_EQ(running, 0);
}

}  // namespace
}  // namespace orbweave
