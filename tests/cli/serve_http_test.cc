// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `serve --http` as a real process: this executable plays the command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/commands/serve_command.h"
#include "cli/process/exit_code.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/http_get.h"
#include "tests/support/toy_job.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::Command;
using testing::CommandOutcome;
using ::testing::HasSubstr;
using testing::HttpGet;
using testing::RunCommand;
using ::testing::StartsWith;
using testing::TcpTalk;
using testing::TemporaryFolder;
using testing::WaitUntil;

constexpr char kOk[] = "HTTP/1.1 200 OK\r\n";

/// A coordinator process with an address for HTTP.
class ServeHttp : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> Serve(const std::vector<std::string>& further) const {
    std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                      "serve",
                                      "--listen",
                                      address_,
                                      "--state",
                                      folder_ / "state"};
    words.insert(words.end(), further.begin(), further.end());
    return words;
  }
  /// Where it serves HTTP; empty: it does not.
  static std::string HttpOf(const Command& serve) {
    const auto says = [&serve](const char* text) {
      return serve.ErrSoFar().find(text) != std::string::npos;
    };
    WaitUntil([&] { return says("coordinator_ready") || !serve.Running(); }, 60.0);
    const std::string log = serve.ErrSoFar();
    const size_t event = log.find(R"("event":"http_ready")");
    if (event == std::string::npos) return {};
    const size_t begin = log.find("address=", event) + sizeof("address=") - 1;
    return log.substr(begin, log.find('"', begin) - begin);
  }
  /// The same with a library loaded into the process.
  [[nodiscard]] std::vector<std::string> ServeBeside(const std::string& library) const {
    std::vector<std::string> words = Serve({"--http", "127.0.0.1:0"});
    words.insert(words.begin(), {"/usr/bin/env", "LD_PRELOAD=" + library});
    return words;
  }

  TemporaryFolder folder_;
  std::string address_ = "unix:" + (folder_ / "s");
};

TEST_F(ServeHttp, ServesItsPages) {
  const Command serve(Serve({"--http", "127.0.0.1:0"}));
  const std::string address = HttpOf(serve);
  ASSERT_THAT(address, StartsWith("127.0.0.1:")) << serve.ErrSoFar();
  EXPECT_THAT(HttpGet(address, "/metrics"),
              HasSubstr("orbweave_events_total{event=\"http_ready\",level=\"info\"} 1\n"));
  EXPECT_THAT(HttpGet(address, "/livez"), HasSubstr("\r\n\r\nok\n"));
  EXPECT_THAT(HttpGet(address, "/readyz"), HasSubstr("\r\n\r\nok\n"));
  EXPECT_THAT(HttpGet(address, "/wanted"), HasSubstr("\r\n\r\n0\n"));
}

TEST_F(ServeHttp, TellsHowManySlotsAreWantedUpToALimit) {
  const Command serve(Serve({"--http", "127.0.0.1:0", "--max-slots", "2"}));
  const std::string address = HttpOf(serve);
  GrpcCoordinatorClient client(address_);
  for (const char* numbers : {"1", "2", "3"}) {
    const auto job = testing::PrepareToyJob(client, numbers);
    ASSERT_TRUE(job.ok() && client.SubmitJob(*job).ok());
  }
  EXPECT_THAT(HttpGet(address, "/wanted"), HasSubstr("\r\n\r\n2\n"));
}

TEST_F(ServeHttp, IsForThisMachineUnlessItIsToBeOpen) {
  const CommandOutcome refused = RunCommand(Serve({"--http", "0.0.0.0:0"}));
  EXPECT_EQ(refused.exit_code, kExitUsage);
  EXPECT_THAT(refused.err, HasSubstr("--http-open"));
  EXPECT_EQ(RunCommand(Serve({"--http-open"})).exit_code, kExitUsage) << "open what?";
  const Command open(Serve({"--http", "0.0.0.0:0", "--http-open"}));
  const std::string address = HttpOf(open);
  ASSERT_THAT(address, StartsWith("0.0.0.0:")) << open.ErrSoFar();
  TcpTalk talk("127.0.0.1" + address.substr(address.rfind(':')));
  talk.Say("GET /livez HTTP/1.1\r\nHost: coordinator.example\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(talk.HearAll(), StartsWith(kOk));
}

TEST_F(ServeHttp, EndsWhileSomebodyIsStillConnected) {
  Command serve(Serve({"--http", "127.0.0.1:0"}));
  TcpTalk halfway(HttpOf(serve));
  halfway.Say("GET /livez HTTP/1.1\r\nHost: local");
  serve.Signal(SIGTERM);
  EXPECT_EQ(serve.Wait().exit_code, kExitOk);
}

TEST_F(ServeHttp, ServesBesideMuchThreadLocalData) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has to be loaded before any other library";
#endif
  const Command serve(ServeBeside(ORBWEAVE_THREAD_LOCAL_DATA));
  const std::string address = HttpOf(serve);
  ASSERT_FALSE(address.empty()) << serve.ErrSoFar();
  EXPECT_THAT(HttpGet(address, "/livez"), StartsWith(kOk));
}

TEST_F(ServeHttp, ServesBesideOpenBlas) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has to be loaded before any other library";
#endif
  const std::string library = "libopenblas.so.0";
  if (!RunCommand({"/usr/bin/env", "LD_PRELOAD=" + library, "/bin/true"}).err.empty())
    GTEST_SKIP() << library << " is not installed";
  const Command serve(ServeBeside(library));
  const std::string address = HttpOf(serve);
  ASSERT_FALSE(address.empty()) << serve.ErrSoFar();
  EXPECT_THAT(HttpGet(address, "/livez"), StartsWith(kOk));
}

/// What `orbweave` would do with these arguments.
void AddCommands(CLI::App& app, SelectedCommand& selected) {
  AddServeCommand(app, selected, testing::FindToyPlan);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
