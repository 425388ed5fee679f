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

  /// The same, to be killed by itself at a fault point.
  [[nodiscard]] std::vector<std::string> ServeUntil(const std::string& fault) const {
    std::vector<std::string> arguments = Serve();
    arguments.insert(arguments.begin(), {"/usr/bin/env", "ORBWEAVE_FAULT=" + fault});
    return arguments;
  }

  [[nodiscard]] std::vector<std::string> Submit(const std::string& output) const {
    return {ORBWEAVE_BINARY,
            "submit",
            "--coordinator",
            address_,
            folder_ / "street/images",
            "--output",
            folder_ / output};
  }

  static int64_t CountOf(const std::string& word, const std::string& text) {
    int64_t count = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      ++count;
    return count;
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
  Command submit(Submit("model"));
  // The worker is stopped in the middle of a task, so that the coordinator dies meanwhile for sure.
  const std::string held = "ended_s IS NULL AND stage = 'extract_features'";
  const auto holds_a_task = [&] {
    worker.Signal(SIGSTOP);
    // Told of it, too: a lease that dies with the coordinator on its way to the worker is granted
    // anew.
    const bool is_told = CountOf("task_leased", worker.ErrSoFar()) == CountAttempts(state, "TRUE");
    if (is_told && CountAttempts(state, held) == 1) return true;
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

TEST_F(KilledCoordinator, SubmitWaitsForItFromTheFirstImageToTheLastResult) {
  Command submit(Submit("model"));
  const auto waits = [&submit] { return submit.ErrSoFar().find("waiting up to 600 s"); };
  ASSERT_TRUE(WaitUntil([&] { return waits() != std::string::npos; }, 60)) << submit.ErrSoFar();
  // While images are sent; before the job is committed; when it is and nobody was told.
  for (const char* fault : {"rename.before:4", "job.before:1", "job.after:1"}) {
    EXPECT_EQ(RunCommand(ServeUntil(fault)).exit_code, 128 + SIGKILL) << fault;
    ASSERT_TRUE(submit.Running()) << submit.ErrSoFar();
  }
  std::optional<Command> serve(std::in_place, Serve());
  const Command worker({ORBWEAVE_BINARY, "work", "--join", address_, "--name", "first"});
  const CommandOutcome first = submit.Wait();
  EXPECT_EQ(first.exit_code, 0) << first.err;
  serve->Signal(SIGKILL);
  (void)serve->Wait();

  // Again, with a coordinator that dies time and again while the results are fetched.
  Command again(Submit("model_again"));
  int killed_in_fetching = 0;
  while (again.Running()) {
    serve.emplace(ServeUntil("get.before:6"));
    ASSERT_TRUE(WaitUntil([&] { return !serve->Running() || !again.Running(); }, 60));
    if (again.Running() && std::filesystem::exists(folder_ / "model_again/sparse/0"))
      ++killed_in_fetching;
  }
  EXPECT_GT(killed_in_fetching, 0) << "all was fetched before the coordinator was killed";
  const CommandOutcome second = again.Wait();
  EXPECT_EQ(second.exit_code, 0) << second.err;
  ExpectSameLocalModel(folder_ / "model", folder_ / "model_again");
}

TEST_F(KilledCoordinator, SubmitGivesUpAfterItsPatience) {
  std::vector<std::string> arguments = Submit("model");
  arguments.insert(arguments.end(), {"--patience", "0.5"});
  const CommandOutcome submit = RunCommand(arguments);
  EXPECT_EQ(submit.exit_code, 3);
  EXPECT_THAT(submit.err, HasSubstr("orbweave: no coordinator answers at " + address_));
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
