// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/fail_on_argument.h"

#include <gtest/gtest.h>

#include <string>

#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

/// The exit code of a job with that verdict under these arguments.
int ExitCodeOfJob(CheckLevel level, const std::string& arguments) {
  CLI::App app;
  FailOn fail_on;
  AddFailOnArgument(app, fail_on);
  app.parse(arguments);
  return ExitCodeOf(CheckVerdict({.level = level}, fail_on));
}

TEST(FailOn, TurnsVerdictsThatBadIntoAnExitCodeOfTheirOwn) {
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kBad, ""), kExitOk);
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kGood, "--fail-on doubtful"), kExitOk);
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kDoubtful, "--fail-on doubtful"), kExitVerdict);
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kBad, "--fail-on doubtful"), kExitVerdict);
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kDoubtful, "--fail-on bad"), kExitOk);
  EXPECT_EQ(ExitCodeOfJob(CheckLevel::kBad, "--fail-on bad"), kExitVerdict);
  EXPECT_THROW(ExitCodeOfJob(CheckLevel::kBad, "--fail-on good"), CLI::ParseError);
  EXPECT_THROW(ExitCodeOfJob(CheckLevel::kBad, "--fail-on 1"), CLI::ParseError);
}

TEST(FailOn, IsToldFromOtherErrors) {
  EXPECT_EQ(ExitCodeOf(absl::FailedPreconditionError("the input is not right")), kExitUsage);
  const absl::Status status = CheckVerdict({.level = CheckLevel::kBad}, CheckLevel::kDoubtful);
  EXPECT_NE(std::string(status.message()).find("judged bad"), std::string::npos);
}

}  // namespace
}  // namespace orbweave
