// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Coordinator and workers started one by one, and the commands of the README.

#include <gmock/gmock.h>

#include <regex>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

TEST(ByHand, ServeWorkSubmitAndStatusDoAJobTogether) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunCommand({ORBWEAVE_BINARY,
                        "synth",
                        "street",
                        "--panoramas",
                        "8",
                        "--size",
                        "512x256",
                        "--output",
                        folder / "street"})
                .exit_code,
            0);
  const std::string address = "unix:" + folder / "s";
  Command serve({ORBWEAVE_BINARY, "serve", "--listen", address, "--state", folder / "state"});
  ASSERT_TRUE(WaitUntil([&] { return std::filesystem::exists(folder / "s"); }, 20))
      << serve.ErrSoFar();
  Command worker({ORBWEAVE_BINARY, "work", "--join", address, "--name", "first", "--slots", "2"});
  const CommandOutcome submitted = RunCommand({ORBWEAVE_BINARY,
                                               "submit",
                                               "--coordinator",
                                               address,
                                               folder / "street/images",
                                               "--output",
                                               folder / "model"});
  EXPECT_EQ(submitted.exit_code, 0) << submitted.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "model/report.json"));
  const CommandOutcome status = RunCommand({ORBWEAVE_BINARY, "status", "--coordinator", address});
  EXPECT_EQ(status.exit_code, 0) << status.err;
  EXPECT_THAT(status.out, HasSubstr("street"));
  worker.Signal(SIGTERM);
  serve.Signal(SIGTERM);
  EXPECT_EQ(serve.Wait().exit_code, 0);
}

TEST(ByHand, AJobThatIsCancelledEnds) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunCommand({ORBWEAVE_BINARY,
                        "synth",
                        "street",
                        "--panoramas",
                        "8",
                        "--size",
                        "128x64",
                        "--output",
                        folder / "street"})
                .exit_code,
            0);
  const std::string address = "unix:" + folder / "s";
  Command serve({ORBWEAVE_BINARY, "serve", "--listen", address, "--state", folder / "state"});
  ASSERT_TRUE(WaitUntil([&] { return std::filesystem::exists(folder / "s"); }, 20))
      << serve.ErrSoFar();
  const CommandOutcome submitted =
      RunCommand({ORBWEAVE_BINARY, "submit", "--coordinator", address, folder / "street/images"});
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  const std::string job = submitted.out.substr(0, 64);
  EXPECT_EQ(RunCommand({ORBWEAVE_BINARY, "cancel", "--coordinator", address, job}).exit_code, 0);
  EXPECT_THAT(RunCommand({ORBWEAVE_BINARY, "status", "--coordinator", address, job}).out,
              HasSubstr("cancelled"));
}

TEST(ByHand, NoCoordinatorIsSaidSo) {
  const TemporaryFolder folder;
  const CommandOutcome status =
      RunCommand({ORBWEAVE_BINARY, "status", "--coordinator", "unix:" + folder / "nobody"});
  EXPECT_EQ(status.exit_code, 3);
  EXPECT_THAT(status.err, HasSubstr("nobody"));
}

/// Commands of the README that need no images of one's own, in order.
std::vector<std::string> ReadmeCommands() {
  std::istringstream readme(ReadAll(std::string(ORBWEAVE_SOURCE_DIR) + "/README.md"));
  std::vector<std::string> commands;
  for (std::string line; std::getline(readme, line);) {
    static const std::regex kSelfContained(
        "orbweave (synth corridor|reconstruct|export|evaluate) .*");
    if (std::regex_match(line, kSelfContained)) commands.push_back(line.substr(0, line.find('#')));
  }
  return commands;
}

TEST(Readme, ItsCommandsWork) {
  const TemporaryFolder folder;
  const std::vector<std::string> commands = ReadmeCommands();
  ASSERT_EQ(commands.size(), 4U);
  const std::string binary_folder = std::filesystem::path(ORBWEAVE_BINARY).parent_path().string();
  for (const std::string& command : commands) {
    const CommandOutcome outcome =
        RunCommand({"/bin/sh",
                    "-c",
                    "cd " + folder.Path() + " && PATH=" + binary_folder + ":$PATH && " + command});
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
}

TEST(Help, EveryCommandHasIt) {
  for (const char* command : {"run",
                              "reconstruct",
                              "evaluate",
                              "export",
                              "bench",
                              "options",
                              "synth",
                              "serve",
                              "work",
                              "submit",
                              "fetch",
                              "stop",
                              "launch",
                              "status",
                              "cancel"}) {
    const CommandOutcome help = RunCommand({ORBWEAVE_BINARY, command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Usage")) << command;
  }
}

}  // namespace
}  // namespace orbweave::testing
