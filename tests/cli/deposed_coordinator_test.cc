// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `serve` with its journal in a real PostgreSQL server, which another coordinator takes over. This
// executable plays the command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/commands/serve_command.h"
#include "cli/process/exit_code.h"
#include "coordinator/journal/postgres_journal.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/postgres_server.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::Command;
using testing::CommandOutcome;
using ::testing::HasSubstr;
using testing::PostgresServer;
using testing::TemporaryFolder;
using testing::WaitUntil;

bool HasSaid(const Command& command, const std::string& text) {
  return WaitUntil([&] { return command.ErrSoFar().find(text) != std::string::npos; }, 60.0);
}

/// The server is started again, which frees the lock, until another coordinator than the one that
/// had the journal is the first to take it.
std::unique_ptr<Journal> TakeJournalOver(PostgresServer& server, const std::string& url) {
  for (int trial = 0; trial < 20; ++trial) {
    server.Stop();
    if (!server.Resume()) return nullptr;
    auto journal = OpenPostgresJournal(url);
    if (journal.ok()) return *std::move(journal);
  }
  return nullptr;
}

TEST(DeposedCoordinator, EndsAndSaysWhy) {
  const std::unique_ptr<PostgresServer> server = PostgresServer::Start();
  if (server == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
  const std::string url = server->MakeDatabase("journal");
  const TemporaryFolder folder;
  const std::string address = "unix:" + (folder / "s");
  Command serve({"/proc/self/exe",
                 "serve",
                 "--listen",
                 address,
                 "--state",
                 folder / "state",
                 "--journal",
                 url,
                 "--lease",
                 "20"});
  ASSERT_TRUE(HasSaid(serve, "coordinator_ready")) << serve.ErrSoFar();
  GrpcCoordinatorClient worker(address);
  const auto joined = worker.Join({.name = "w", .version = std::string(BuildVersion())});
  ASSERT_TRUE(joined.ok()) << joined.status();
  const std::unique_ptr<Journal> successor = TakeJournalOver(*server, url);
  ASSERT_NE(successor, nullptr);
  ASSERT_TRUE(WaitUntil([&serve] { return !serve.Running(); }, 60.0)) << "it goes on";
  const CommandOutcome end = serve.Wait();
  EXPECT_EQ(end.exit_code, kExitFailed);
  EXPECT_THAT(end.err, HasSubstr("\"event\":\"journal_lost\""));
  EXPECT_THAT(end.err, HasSubstr("orbweave: the journal is in use by another coordinator"));
  EXPECT_THAT(end.err, ::testing::Not(HasSubstr("coordinator_stops")));
  EXPECT_TRUE(absl::IsUnavailable(worker.Heartbeat(joined->session, {}).status()));
  EXPECT_TRUE(successor->Confirm().ok());
}

void AddCommands(CLI::App& app, SelectedCommand& selected) {
  AddServeCommand(app, selected, FindNoPlan);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
