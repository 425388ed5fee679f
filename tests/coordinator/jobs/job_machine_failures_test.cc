// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/coordinator/line_job.h"

namespace orbweave {
namespace {

using testing::Begin;
using ::testing::HasSubstr;
using testing::LeaseNext;
using testing::LinePlan;
using testing::MachineFor;
using testing::Tasks;

TEST(JobMachineFailures, RemembersFailuresOfBeforeARestart) {
  JobMachine machine = MachineFor({"a"});
  const std::vector<TaskSpec> tasks = Tasks("a", 2);
  const FailedAttempt crash{tasks[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash});
  Begin(machine, "a", 2);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 1U);
  EXPECT_THAT(machine.FailedOn({0, 0}), ::testing::ElementsAre("w"));
  EXPECT_EQ(machine.NextReady({"w"}, {"other", "w"}, 200.0)->part, 1U) << "another worker first";
  const AttemptRef again = LeaseNext(machine, "other", 200.0);
  ASSERT_EQ(again.task.part, 0U);
  machine.TaskFailed(again, absl::AbortedError("signal 11"), 200.0);
  EXPECT_EQ(machine.state(), JobState::kFailed) << "two are too many";
  EXPECT_THAT(machine.error(), HasSubstr("lost its process 2 times, last on other"));
}

TEST(JobMachineFailures, FailsWhereTheRestartCameBeforeItWasSaid) {
  JobMachine machine = MachineFor({"a"});
  const FailedAttempt crash{Tasks("a", 1)[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash, crash});
  Begin(machine, "a", 1);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(),
              HasSubstr("lost its process 2 times, last on w: ABORTED: signal 11"));
}

TEST(JobMachineFailures, FailuresOfTasksThatAreDoneCountForTheJobAlone) {
  JobMachine machine = MachineFor({"a"});
  const FailedAttempt crash{Tasks("a", 1)[0].Id(), "w", absl::StatusCode::kAborted, "signal 11"};
  machine.Remember({crash, crash});
  machine.StageBegins(Tasks("a", 2), {TaskResult{}, std::nullopt}, 100.0);
  EXPECT_EQ(machine.state(), JobState::kRunning);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 2U);
}

TEST(JobMachineFailures, RetriesATransientFailureAfterAWait) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::UnavailableError("gone"), 100.0);
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 100.4), std::nullopt);
  EXPECT_TRUE(machine.MayHaveWork());
  EXPECT_FALSE(machine.MayHaveWork(100.4)) << "its time has not come";
  EXPECT_TRUE(machine.MayHaveWork(101.0));
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 101.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.Status(101.0).stages[0].retries, 1U);
}

TEST(JobMachineFailures, PrefersAWorkerThatHasNotFailedTheTask) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), absl::InternalError("crash"), 100.0);
  EXPECT_EQ(machine.NextReady({"w1"}, {"w1", "w2"}, 200.0), std::nullopt);
  EXPECT_EQ(machine.NextReady({"w2"}, {"w1", "w2"}, 200.0), (TaskRef{0, 0}));
  EXPECT_EQ(machine.NextReady({"w1"}, {"w1"}, 200.0), (TaskRef{0, 0}));
}

TEST(JobMachineFailures, FailsAfterTheLastAttemptAndSaysWhatAndWhy) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 2);
  for (int attempt = 0; attempt < 3; ++attempt) {
    ASSERT_EQ(machine.state(), JobState::kRunning);
    machine.TaskFailed(LeaseNext(machine, "w", 1000.0 * attempt + 100.0),
                       absl::InternalError("segfault"),
                       1000.0 * attempt + 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("stage a, part 0"));
  EXPECT_THAT(machine.error(), HasSubstr("failed 3 times"));
  EXPECT_THAT(machine.error(), HasSubstr("segfault"));
  EXPECT_EQ(machine.NextReady({"w"}, {"w"}, 9000.0), std::nullopt);
}

TEST(JobMachineFailures, CountsFailuresByTheirClass) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  double now_s = 100.0;
  const auto fail = [&](const absl::Status& error) {
    machine.TaskFailed(LeaseNext(machine, "w", now_s), error, now_s);
    now_s += 100.0;
  };
  for (int i = 0; i < 3; ++i) fail(absl::UnavailableError("went silent"));
  for (int i = 0; i < 2; ++i) fail(absl::InternalError("no luck"));
  fail(absl::AbortedError("signal 9"));
  EXPECT_EQ(machine.state(), JobState::kRunning) << machine.error();
  fail(absl::ResourceExhaustedError("out of memory"));
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("failed 4 times"));
}

TEST(JobMachineFailures, NamesTheInputsOfATaskThatKillsItsProcesses) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), absl::AbortedError("signal 11"), 100.0);
  machine.TaskFailed(LeaseNext(machine, "w2", 200.0), absl::DeadlineExceededError("hung"), 200.0);
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("stage a, part 0"));
  EXPECT_THAT(machine.error(), HasSubstr("lost its process 2 times, last on w2"));
  EXPECT_THAT(machine.error(), HasSubstr("its inputs: " + DigestOf("0").ToShortHex()));
}

TEST(JobMachineFailures, GivesUpWhenTooMuchOfItFails) {
  constexpr uint32_t kTasks = 20;
  JobMachine machine({.kind = "line"},
                     LinePlan({"a"}),
                     {.job_retries = 4, .job_retry_share = 0.1, .first_wait_s = 1.0},
                     100.0);
  Begin(machine, "a", kTasks);
  for (int failures = 0; failures < 7; ++failures) {
    ASSERT_EQ(machine.state(), JobState::kRunning) << failures;
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::UnavailableError("no store"), 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("gave up after 7 failed attempts at 20 tasks"));
}

TEST(JobMachineFailures, FailsAtOnceWhenAnErrorIsPermanent) {
  for (const absl::Status& error : {absl::InvalidArgumentError("no images"),
                                    absl::FailedPreconditionError("no images"),
                                    absl::OutOfRangeError("no images")}) {
    JobMachine machine = MachineFor({"a"});
    Begin(machine, "a", 1);
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), error, 100.0);
    EXPECT_EQ(machine.state(), JobState::kFailed);
    EXPECT_THAT(machine.error(), HasSubstr("no images"));
  }
}

TEST(JobMachineFailures, HearsASecondWorkerWhereThereIsOneBeforeAnErrorIsPermanent) {
  const absl::Status error = absl::InvalidArgumentError("no images");
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), error, 100.0, {"w1", "w2"});
  EXPECT_EQ(machine.state(), JobState::kRunning);
  EXPECT_EQ(machine.NextReady({"w1"}, {"w1", "w2"}, 200.0), std::nullopt);
  machine.TaskFailed(LeaseNext(machine, "w2", 200.0), error, 200.0, {"w1", "w2", "w3"});
  EXPECT_EQ(machine.state(), JobState::kFailed);
  EXPECT_THAT(machine.error(), HasSubstr("no images"));
}

TEST(JobMachineFailures, DoesNotWaitForASecondWorkerThatLeft) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  const absl::Status error = absl::InvalidArgumentError("no images");
  machine.TaskFailed(LeaseNext(machine, "w1", 100.0), error, 100.0, {"w1", "w2"});
  machine.TaskFailed(LeaseNext(machine, "w1", 200.0), error, 200.0, {"w1"});
  EXPECT_EQ(machine.state(), JobState::kFailed);
}

TEST(JobMachineFailures, AReturnedTaskIsReadyAtOnceAndDoesNotCount) {
  JobMachine machine = MachineFor({"a"});
  Begin(machine, "a", 1);
  for (int i = 0; i < 10; ++i) {
    machine.TaskFailed(LeaseNext(machine, "w", 100.0), absl::CancelledError("shutdown"), 100.0);
  }
  EXPECT_EQ(machine.state(), JobState::kRunning);
  EXPECT_EQ(machine.Status(100.0).stages[0].retries, 0U);
}

}  // namespace
}  // namespace orbweave
