// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `forget` and `gc` on the state that two real jobs left: the second differs from the first in one
// option.

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

namespace fs = std::filesystem;

class CollectedGarbage : public ::testing::Test {
 protected:
  /// Reconstructs the corridor in clusters of this size.
  void Reconstruct(const std::string& cluster_size) {
    std::vector<std::string> command = ReconstructCorridor(output_, 1);
    command.back() = "partition.cluster_size=" + cluster_size;
    const CommandOutcome run = RunCommand(command);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  /// How many tasks were handed out so far.
  [[nodiscard]] int64_t NumComputed() const {
    std::istringstream log(ReadAll(state_ + "/logs/coordinator.log"));
    int64_t number = 0;
    for (std::string line; std::getline(log, line);)
      number += line.find("\"event\":\"task_leased\"") != std::string::npos ? 1 : 0;
    return number;
  }

  [[nodiscard]] std::vector<fs::path> Blobs() const {
    std::vector<fs::path> blobs;
    for (const auto& entry : fs::recursive_directory_iterator(state_ + "/blobs")) {
      if (entry.is_regular_file()) blobs.push_back(entry.path());
    }
    std::ranges::sort(blobs);
    return blobs;
  }

  /// As if nobody had used anything for two hours.
  void Age() const {
    for (const fs::path& blob : Blobs())
      fs::last_write_time(blob, fs::file_time_type::clock::now() - std::chrono::hours(2));
  }

  /// Forgets the older job and collects what it alone needed.
  void ForgetTheOlder() {
    const std::string address = "unix:" + folder_ / "s";
    const Command serve({ORBWEAVE_BINARY, "serve", "--listen", address, "--state", state_});
    const auto ask = [&address](std::vector<std::string> command) {
      command.insert(command.begin(), ORBWEAVE_BINARY);
      command.insert(command.begin() + 2, {"--coordinator", address, "--patience", "60"});
      CommandOutcome outcome = RunCommand(command);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      return outcome.out;
    };
    const std::string jobs = ask({"status", "--json"});
    const auto older = nlohmann::json::parse(jobs.substr(0, jobs.find('\n')), nullptr, false);
    ASSERT_TRUE(older.contains("id")) << jobs;
    Age();
    EXPECT_THAT(ask({"gc", "--unused-for", "1"}), ::testing::ContainsRegex("removed +0 blobs"));
    ask({"forget", older["id"].get<std::string>()});
    ask({"gc", "--unused-for", "1"});
  }

  TemporaryFolder folder_;
  std::string output_ = folder_ / "job";
  std::string state_ = output_ + "/.orbweave";
};

TEST_F(CollectedGarbage, IsWhatTheForgottenJobAloneNeeded) {
  Reconstruct("16");
  fs::copy(output_, folder_ / "first", fs::copy_options::recursive);
  const int64_t of_first = NumComputed();
  Reconstruct("20");
  fs::copy(output_, folder_ / "second", fs::copy_options::recursive);
  const int64_t of_both = NumComputed();
  const size_t blobs_of_both = Blobs().size();
  ASSERT_NO_FATAL_FAILURE(ForgetTheOlder());
  const size_t blobs_of_second = Blobs().size();
  EXPECT_LT(blobs_of_second, blobs_of_both);

  Reconstruct("20");
  EXPECT_EQ(NumComputed(), of_both) << "all that it needs is there";
  EXPECT_EQ(Blobs().size(), blobs_of_second);
  ExpectSameModel(folder_ / "second", output_);

  Reconstruct("16");
  const int64_t again = NumComputed() - of_both;
  EXPECT_GT(again, of_first / 2) << "what it alone needed is gone";
  EXPECT_LT(again, of_first) << "what both need is there";
  EXPECT_EQ(Blobs().size(), blobs_of_both);
  ExpectSameModel(folder_ / "first", output_);
}

}  // namespace
}  // namespace orbweave::testing
