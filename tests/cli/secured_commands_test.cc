// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A fleet set up by its commands: `keys`, `serve`, `work` and `status` as real processes with TLS
// between them, on an address that others could reach.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/keys_command.h"
#include "cli/commands/serve_command.h"
#include "cli/commands/status_command.h"
#include "cli/commands/work_command.h"
#include "cli/process/exit_code.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

using testing::Command;
using testing::CommandOutcome;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadAll;
using testing::RunCommand;
using testing::TemporaryFolder;
using testing::WaitUntil;

std::vector<std::string> Orbweave(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "/proc/self/exe");
  return arguments;
}

class SecuredCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandOutcome made = RunCommand(Orbweave({"keys", "init", keys_, "--fleet", "city"}));
    ASSERT_EQ(made.exit_code, kExitOk) << made.err;
    Serve("0.0.0.0:0");
  }

  void Serve(const std::string& address) {
    serve_ = std::make_unique<Command>(Orbweave({"serve",
                                                 "--listen",
                                                 address,
                                                 "--state",
                                                 folder_ / "state",
                                                 "--tls",
                                                 keys_ + "/coordinator"}));
    const std::string mark = "address=0.0.0.0:";
    ASSERT_TRUE(WaitUntil([&] { return serve_->ErrSoFar().find(mark) != std::string::npos; }, 60.0))
        << serve_->ErrSoFar();
    const std::string log = serve_->ErrSoFar();
    const size_t begin = log.find(mark) + mark.size();
    port_ = log.substr(begin, log.find(' ', begin) - begin);
  }

  std::string MakeToken(const std::string& minutes = "10") {
    const std::string path = folder_ / "join.token";
    const CommandOutcome made =
        RunCommand(Orbweave({"keys", "token", keys_, "--output", path, "--minutes", minutes}));
    EXPECT_EQ(made.exit_code, kExitOk) << made.err;
    EXPECT_THAT(made.out, Not(HasSubstr(ReadAll(path))));
    token_number_ = made.out.substr(std::string("join token ").size(), 32);
    return path;
  }

  std::vector<std::string> Work(const std::string& tls, const std::string& token) {
    return Orbweave({"work", "--join", Address(), "--tls", folder_ / tls, "--token-file", token});
  }

  CommandOutcome Status(const std::string& tls) {
    return RunCommand(Orbweave({"status", "--coordinator", Address(), "--tls", tls}));
  }

  bool CoordinatorSays(const std::string& text) {
    return WaitUntil([&] { return serve_->ErrSoFar().find(text) != std::string::npos; }, 60.0);
  }

  [[nodiscard]] std::string Address() const { return "127.0.0.1:" + port_; }

  TemporaryFolder folder_;
  std::string keys_ = folder_ / "keys";
  std::string token_number_{};  ///< of the last MakeToken
  std::string port_;
  std::unique_ptr<Command> serve_;
};

TEST_F(SecuredCommands, AWorkerJoinsWithNothingButATokenAndLaterWithoutIt) {
  const std::string token = MakeToken();
  {
    Command worker(Work("worker", token));
    EXPECT_TRUE(CoordinatorSays("worker_joined")) << worker.ErrSoFar();
    EXPECT_TRUE(CoordinatorSays("certificate_given"));
    worker.Signal(SIGTERM);
    EXPECT_EQ(worker.Wait().exit_code, kExitStopped);
    EXPECT_TRUE(CoordinatorSays("worker_left"));
    EXPECT_THAT(worker.ErrSoFar(), Not(HasSubstr(ReadAll(token))));
  }
  EXPECT_THAT(serve_->ErrSoFar(), Not(HasSubstr(ReadAll(token))));
  std::filesystem::remove(token);
  serve_->Signal(SIGTERM);
  EXPECT_EQ(serve_->Wait().exit_code, kExitOk);
  Serve("0.0.0.0:" + port_);
  Command again(Orbweave({"work", "--join", Address(), "--tls", folder_ / "worker"}));
  EXPECT_TRUE(CoordinatorSays("worker_joined")) << again.ErrSoFar();
}

TEST_F(SecuredCommands, AConnectedWorkerComesBackToACoordinatorThatWasKilled) {
  ASSERT_EQ(RunCommand(Orbweave({"keys", "add", keys_, "worker", "node7"})).exit_code, kExitOk);
  const Command worker(Orbweave({"work", "--join", Address(), "--tls", keys_ + "/node7"}));
  ASSERT_TRUE(CoordinatorSays("worker_joined")) << worker.ErrSoFar();
  serve_->Signal(SIGKILL);
  serve_->Wait();
  // Away for so long that the worker has been refused, and waits between its attempts.
  ASSERT_TRUE(WaitUntil(
      [&worker] { return worker.ErrSoFar().find("Connection refused") != std::string::npos; },
      60.0))
      << worker.ErrSoFar();
  Serve("0.0.0.0:" + port_);
  EXPECT_TRUE(CoordinatorSays("worker_joined")) << worker.ErrSoFar();
}

TEST_F(SecuredCommands, AUsedTokenIsRefusedByACoordinatorThatWasKilledAndCameBack) {
  const std::string token = MakeToken();
  {
    const Command first(Work("first", token));
    EXPECT_TRUE(CoordinatorSays("worker_joined")) << first.ErrSoFar();
  }
  serve_->Signal(SIGKILL);
  serve_->Wait();
  Serve("0.0.0.0:" + port_);
  const CommandOutcome second = RunCommand(Work("second", token));
  EXPECT_EQ(second.exit_code, kExitUsage);
  EXPECT_THAT(second.err, HasSubstr("used before"));
}

TEST_F(SecuredCommands, AnExpiredTokenIsRefused) {
  const std::string token = MakeToken("0.01");
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  const CommandOutcome late = RunCommand(Work("late", token));
  EXPECT_EQ(late.exit_code, kExitUsage);
  EXPECT_THAT(late.err, HasSubstr("expired"));
}

TEST_F(SecuredCommands, ATokenThatOthersMayReadIsNotTaken) {
  const std::string token = MakeToken();
  std::filesystem::permissions(token, std::filesystem::perms(0644));
  const CommandOutcome open = RunCommand(Work("worker", token));
  EXPECT_EQ(open.exit_code, kExitUsage);
  EXPECT_THAT(open.err, HasSubstr("open to others"));
}

TEST_F(SecuredCommands, ClientsAskAndWorkersDoNot) {
  EXPECT_EQ(Status(keys_ + "/client").exit_code, kExitOk);
  EXPECT_EQ(Status(keys_ + "/admin").exit_code, kExitOk);
  ASSERT_EQ(RunCommand(Orbweave({"keys", "add", keys_, "worker", "node7"})).exit_code, kExitOk);
  const CommandOutcome worker = Status(keys_ + "/node7");
  EXPECT_EQ(worker.exit_code, kExitUsage);
  EXPECT_THAT(worker.err, HasSubstr("a worker may not call"));
  const CommandOutcome plain =
      RunCommand(Orbweave({"status", "--coordinator", Address(), "--patience", "0"}));
  EXPECT_EQ(plain.exit_code, kExitUnavailable);
}

TEST_F(SecuredCommands, AWorkerThatTakesAnothersNameIsRefused) {
  ASSERT_EQ(RunCommand(Orbweave({"keys", "add", keys_, "worker", "node7"})).exit_code, kExitOk);
  const CommandOutcome posing = RunCommand(
      Orbweave({"work", "--join", Address(), "--tls", keys_ + "/node7", "--name", "node8"}));
  EXPECT_EQ(posing.exit_code, kExitUsage);
  EXPECT_THAT(posing.err, HasSubstr("not as 'node8'"));
}

TEST_F(SecuredCommands, ARevokedWorkerSaysSoAndEnds) {
  ASSERT_EQ(RunCommand(Orbweave({"keys", "add", keys_, "worker", "node7"})).exit_code, kExitOk);
  const std::vector<std::string> work =
      Orbweave({"work", "--join", Address(), "--tls", keys_ + "/node7"});
  Command worker(work);
  ASSERT_TRUE(CoordinatorSays("worker_joined")) << worker.ErrSoFar();
  const CommandOutcome revoked = RunCommand(Orbweave({"keys", "revoke", keys_, "node7"}));
  ASSERT_EQ(revoked.exit_code, kExitOk) << revoked.err;
  const CommandOutcome ended = worker.Wait();
  EXPECT_EQ(ended.exit_code, kExitUsage);
  EXPECT_THAT(ended.err, HasSubstr("orbweave: orbweave://city/worker/node7 is revoked"));
  serve_->Signal(SIGKILL);
  serve_->Wait();
  Serve("0.0.0.0:" + port_);
  EXPECT_EQ(RunCommand(work).exit_code, kExitUsage) << "also by a coordinator that came back";
  EXPECT_EQ(Status(keys_ + "/client").exit_code, kExitOk);
}

TEST_F(SecuredCommands, ARevokedTokenLetsNobodyIn) {
  const std::string token = MakeToken();
  const CommandOutcome revoked =
      RunCommand(Orbweave({"keys", "revoke", keys_, "--token", token_number_}));
  ASSERT_EQ(revoked.exit_code, kExitOk) << revoked.err;
  const CommandOutcome refused = RunCommand(Work("node", token));
  EXPECT_EQ(refused.exit_code, kExitUsage);
  EXPECT_THAT(refused.err, HasSubstr("the join token is revoked"));
  EXPECT_EQ(RunCommand(Orbweave({"keys", "revoke", keys_, "--token", "12"})).exit_code, kExitUsage);
}

TEST_F(SecuredCommands, AWorkerOfAnotherAuthoritySaysSoAndEnds) {
  const std::string foreign = folder_ / "foreign";
  ASSERT_EQ(RunCommand(Orbweave({"keys", "init", foreign, "--fleet", "city"})).exit_code, kExitOk);
  ASSERT_EQ(RunCommand(Orbweave({"keys", "add", foreign, "worker", "node7"})).exit_code, kExitOk);
  const std::vector<std::string> work =
      Orbweave({"work", "--join", Address(), "--tls", foreign + "/node7"});
  const CommandOutcome deceived = RunCommand(work);
  EXPECT_EQ(deceived.exit_code, kExitUsage);
  EXPECT_THAT(deceived.err, HasSubstr("certificate of the coordinator"));
  std::filesystem::copy_file(keys_ + "/client/ca.crt",
                             foreign + "/node7/ca.crt",
                             std::filesystem::copy_options::overwrite_existing);
  const CommandOutcome refused = RunCommand(work);
  EXPECT_EQ(refused.exit_code, kExitUsage);
  EXPECT_THAT(refused.err, HasSubstr("refuses the certificate"));
}

/// What `orbweave` would do with these arguments.
void AddCommands(CLI::App& app, SelectedCommand& selected) {
  static const testing::StageMap stages = testing::ToyStages();
  static const StageLookup lookup = testing::LookupIn(stages);
  AddKeysCommand(app, selected);
  AddServeCommand(app, selected, FindNoPlan);
  AddWorkCommand(app, selected);
  AddExecTasksCommand(app, selected, lookup);
  AddStatusCommand(app, selected);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
