// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/status.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

absl::StatusOr<int> Half(int number) {
  if (number % 2 != 0) return absl::InvalidArgumentError("odd");
  return number / 2;
}

absl::StatusOr<int> Quarter(int number) {
  ORBWEAVE_ASSIGN_OR_RETURN(const int half, Half(number));
  ORBWEAVE_ASSIGN_OR_RETURN(const int quarter, Half(half));
  return quarter;
}

absl::Status MustBeEven(int number) {
  ORBWEAVE_RETURN_IF_ERROR(Half(number).status());
  return absl::OkStatus();
}

TEST(Status, IsPassedUp) {
  EXPECT_EQ(*Quarter(12), 3);
  EXPECT_EQ(Quarter(6).status().message(), "odd");
  EXPECT_TRUE(MustBeEven(2).ok());
  EXPECT_EQ(MustBeEven(3).code(), absl::StatusCode::kInvalidArgument);
}

TEST(Annotate, SaysWhereAndKeepsTheCode) {
  const absl::Status status = Annotate(absl::NotFoundError("no row"), "gnss.csv");
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(status.message(), "gnss.csv: no row");
  EXPECT_TRUE(Annotate(absl::OkStatus(), "anything").ok());
}

TEST(CheckDeathTest, NamesTheBrokenPromise) {
  EXPECT_DEATH(ORBWEAVE_CHECK(1 + 1 == 3), "broken promise: 1 \\+ 1 == 3");
}

}  // namespace
}  // namespace orbweave
