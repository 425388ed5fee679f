// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator killed for real while a worker computes: the worker goes on with its task.

#include <gmock/gmock.h>

#include "tests/jobs/corridor_job.h"
#include "tests/support/postgres_server.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

/// How many rows of the journal are as `condition` says.
int64_t CountAttempts(const std::string& state, const std::string& condition) {
  const auto journal = SqliteConnection::OpenToRead(state + "/journal.db");
  if (!journal.ok()) return 0;
  auto count = journal->Prepare("SELECT COUNT(*) FROM orbweave_attempt WHERE " + condition);
  return count.ok() && count->Step().ok() ? count->Integer(0) : 0;
}

class KilledCoordinator : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandOutcome made = RunCommand({ORBWEAVE_BINARY,
                                            "synth",
                                            "street",
                                            "--panoramas",
                                            "8",
                                            "--size",
                                            "512x256",
                                            "--output",
                                            folder_ / "street"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  [[nodiscard]] std::vector<std::string> Serve(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        ORBWEAVE_BINARY, "serve", "--listen", address_, "--state", folder_ / "state"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static bool IsReady(const Command& serve) {
    return WaitUntil(
        [&] { return serve.ErrSoFar().find("coordinator_ready") != std::string::npos; }, 30);
  }

  TemporaryFolder folder_;
  std::string address_ = "unix:" + folder_ / "s";
};

TEST_F(KilledCoordinator, ItsWorkerGoesOnAndEveryTaskIsComputedOnce) {
  const std::string state = folder_ / "state";
  std::optional<Command> serve(std::in_place, Serve());
  ASSERT_TRUE(IsReady(*serve)) << serve->ErrSoFar();
  Command worker({ORBWEAVE_BINARY, "work", "--join", address_, "--name", "first"});
  Command submit({ORBWEAVE_BINARY,
                  "submit",
                  "--coordinator",
                  address_,
                  folder_ / "street/images",
                  "--output",
                  folder_ / "model"});
  // The worker is stopped in the middle of a task, so that the coordinator dies meanwhile for sure.
  const std::string held = "ended_s IS NULL AND stage = 'extract_features'";
  const auto holds_a_task = [&] {
    worker.Signal(SIGSTOP);
    if (CountAttempts(state, held) == 1) return true;
    worker.Signal(SIGCONT);
    return false;
  };
  ASSERT_TRUE(WaitUntil(holds_a_task, 60)) << worker.ErrSoFar();
  serve->Signal(SIGKILL);
  EXPECT_EQ(serve->Wait().exit_code, 128 + SIGKILL);
  ASSERT_EQ(CountAttempts(state, held), 1) << "the task ended before the coordinator was killed";
  serve.emplace(Serve());
  ASSERT_TRUE(IsReady(*serve)) << serve->ErrSoFar();
  worker.Signal(SIGCONT);
  const CommandOutcome submitted = submit.Wait();
  EXPECT_EQ(submitted.exit_code, 0) << submitted.err << serve->ErrSoFar() << worker.ErrSoFar();
  const int64_t attempts = CountAttempts(state, "TRUE");
  EXPECT_GT(CountAttempts(state, "epoch > 8589934592"), 0) << "of the second coordinator";
  EXPECT_EQ(CountAttempts(state, "reason = ''"), attempts) << "each attempt brought its result";
  EXPECT_EQ(CountAttempts(state, "task IN (SELECT task FROM orbweave_result)"), attempts);
  EXPECT_EQ(FinishedTasksIn(state + "/journal.db"), static_cast<size_t>(attempts)) << "one each";

  const std::string undisturbed = folder_ / "undisturbed";
  const CommandOutcome run =
      RunCommand({ORBWEAVE_BINARY, "run", folder_ / "street/images", "--output", undisturbed});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  ExpectSameLocalModel(undisturbed, folder_ / "model");
}

TEST_F(KilledCoordinator, OnPostgresASecondOneIsRefusedUntilTheFirstIsDead) {
  const auto server = PostgresServer::Start();
  if (server == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
  const std::vector<std::string> journal = {"--journal", server->MakeDatabase("journal")};
  std::optional<Command> serve(std::in_place, Serve(journal));
  ASSERT_TRUE(IsReady(*serve)) << serve->ErrSoFar();
  const CommandOutcome second = RunCommand({ORBWEAVE_BINARY,
                                            "serve",
                                            "--listen",
                                            "unix:" + folder_ / "s2",
                                            "--state",
                                            folder_ / "state2",
                                            journal[0],
                                            journal[1]});
  EXPECT_NE(second.exit_code, 0);
  EXPECT_THAT(second.err, HasSubstr("in use by another coordinator"));
  const CommandOutcome submitted =
      RunCommand({ORBWEAVE_BINARY, "submit", "--coordinator", address_, folder_ / "street/images"});
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  serve->Signal(SIGKILL);
  (void)serve->Wait();
  serve.emplace(Serve(journal));
  ASSERT_TRUE(IsReady(*serve)) << serve->ErrSoFar();
  const CommandOutcome status = RunCommand({ORBWEAVE_BINARY, "status", "--coordinator", address_});
  EXPECT_THAT(status.out, HasSubstr("street")) << "the job is remembered";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "state/journal.db"));
}

}  // namespace
}  // namespace orbweave::testing
