// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Real task processes: this very executable, called with `exec-tasks`, runs stages that crash, hang
// and eat memory.

#include "worker/task_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "core/pipeline/damaged_blob.h"
#include "tests/support/command.h"
#include "tests/support/memory_blobs.h"
#include "tests/support/toy_job.h"
#include "worker/confine_process.h"
#include "worker/serve_tasks.h"

namespace orbweave {
namespace {

using testing::ChildrenOf;
using ::testing::HasSubstr;

constexpr size_t kMemoryLimit = size_t{512} << 20;

absl::StatusOr<TaskResult> PutText(BlobAccess& blobs, const std::string& text) {
  TaskResult result{.report_json = "{}"};
  ORBWEAVE_ASSIGN_OR_RETURN(result.outputs.emplace_back(), blobs.Put(text));
  return result;
}

absl::StatusOr<TaskResult> CopyInput(const TaskSpec& spec, BlobAccess& blobs, const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs.Get(spec.inputs.at(0)));
  return PutText(blobs, bytes);
}

absl::StatusOr<TaskResult> BlameInput(const TaskSpec& spec, BlobAccess&, const StageContext&) {
  return BlameBlob(absl::DataLossError("no number"), spec.inputs.at(0));
}

absl::StatusOr<TaskResult> TellContext(const TaskSpec&,
                                       BlobAccess& blobs,
                                       const StageContext& context) {
  context.Report(3, 4, "things");
  return PutText(blobs, std::to_string(context.num_threads) + " " + std::to_string(context.seed));
}

absl::StatusOr<TaskResult> TellPid(const TaskSpec&, BlobAccess& blobs, const StageContext&) {
  return PutText(blobs, std::to_string(::getpid()));
}

absl::StatusOr<TaskResult> TellSocket(const TaskSpec&, BlobAccess& blobs, const StageContext&) {
  const bool opened = ::socket(AF_INET, SOCK_STREAM, 0) >= 0;
  return PutText(blobs, opened ? "open" : std::strerror(errno));
}

/// Dies of the signal that its option names.
absl::StatusOr<TaskResult> Die(const TaskSpec& spec, BlobAccess&, const StageContext&) {
  const int signal = std::stoi(spec.options_text);
  ::signal(signal, SIG_DFL);  // a sanitizer would exit instead
  ::raise(signal);
  return absl::InternalError("survived");
}

absl::StatusOr<TaskResult> Leave(const TaskSpec&, BlobAccess&, const StageContext&) {
  std::_Exit(7);
}

absl::StatusOr<TaskResult> WaitForStop(const TaskSpec&, BlobAccess&, const StageContext& context) {
  while (context.CheckStop().ok()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return context.CheckStop();
}

absl::StatusOr<TaskResult> Hang(const TaskSpec&, BlobAccess&, const StageContext&) {
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Computes for as many seconds as its option says, and only looks whether it is to stop.
absl::StatusOr<TaskResult> Compute(const TaskSpec& spec,
                                   BlobAccess& blobs,
                                   const StageContext& context) {
  const SteadyClock clock;
  const double end_s = clock.NowSeconds() + std::stod(spec.options_text);
  while (clock.NowSeconds() < end_s) ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  return PutText(blobs, "computed");
}

/// An endless loop.
absl::StatusOr<TaskResult> Spin(const TaskSpec&, BlobAccess&, const StageContext&) {
  for (std::atomic<uint64_t> rounds = 0; true; ++rounds) {
  }
}

absl::StatusOr<TaskResult> EatMemory(const TaskSpec&, BlobAccess& blobs, const StageContext&) {
  std::vector<std::string> eaten;
  while (eaten.size() < 4096) eaten.emplace_back(size_t{1} << 20, 'x');
  return PutText(blobs, "not full yet");
}

testing::StageMap Stages() {
  return {{"copy", CopyInput},
          {"blame", BlameInput},
          {"context", TellContext},
          {"pid", TellPid},
          {"socket", TellSocket},
          {"die", Die},
          {"leave", Leave},
          {"wait", WaitForStop},
          {"hang", Hang},
          {"compute", Compute},
          {"spin", Spin},
          {"eat", EatMemory}};
}

class TaskProcessTest : public ::testing::Test {
 protected:
  explicit TaskProcessTest(const TaskLimits& limits = {}) : process_(limits, clock_) {}

  absl::StatusOr<TaskResult> Run(const std::string& stage,
                                 const std::string& options = "",
                                 const StageContext& context = {}) {
    return RunSpec({.stage = stage, .options_text = options}, context);
  }

  absl::StatusOr<TaskResult> RunSpec(const TaskSpec& spec, const StageContext& context = {}) {
    TaskBlobs blobs(cache_);
    absl::StatusOr<TaskResult> result = process_.Run(spec, blobs, context);
    EXPECT_TRUE(blobs.Settle().ok());
    return result;
  }

  /// The text that a task leaves behind.
  std::string TextOf(const std::string& stage, const std::string& options = "") {
    const auto result = Run(stage, options);
    if (!result.ok()) return result.status().ToString();
    return *blobs_.Get(result->outputs.at(0));
  }

  testing::MemoryBlobs blobs_;
  BlobCache cache_{blobs_, size_t{64} << 20, {}};
  SteadyClock clock_;
  TaskProcess process_;
};

TEST_F(TaskProcessTest, RunsTasksInOneOtherProcess) {
  const std::string pid = TextOf("pid");
  EXPECT_NE(pid, std::to_string(::getpid()));
  EXPECT_THAT(ChildrenOf(::getpid()), ::testing::ElementsAre(std::stoi(pid)));
  EXPECT_EQ(TextOf("pid"), pid);
}

TEST_F(TaskProcessTest, CarriesBlobsOfAllSizesBothWays) {
  for (const size_t size :
       {size_t{0}, size_t{1}, size_t{100'000}, size_t{200'000}, size_t{9} << 20}) {
    std::string bytes(size, '\0');
    for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 7 + i / 251);
    const Digest digest = *blobs_.Put(bytes);
    const auto result = RunSpec({.stage = "copy", .inputs = {digest}});
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->outputs.at(0), digest);
    EXPECT_EQ(result->cost.bytes_in, size);
    EXPECT_EQ(result->cost.bytes_out, size);
  }
}

TEST_F(TaskProcessTest, HandsOverTheContextAndReportsProgress) {
  std::vector<Progress> reports;
  const StageContext context{
      .report = [&reports](const Progress& progress) { reports.push_back(progress); },
      .num_threads = 3,
      .seed = 0xfedc'ba98'7654'3210};
  const auto result = Run("context", "", context);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(*blobs_.Get(result->outputs.at(0)), "3 " + std::to_string(context.seed));
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].done, 3U);
  EXPECT_EQ(reports[0].total, 4U);
  EXPECT_EQ(reports[0].unit, "things");
}

TEST_F(TaskProcessTest, MeasuresWhatTheTaskTookInItsProcess) {
  const auto result = Run("compute", "0.3");
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_GE(result->cost.wall_s, 0.3);
  EXPECT_GT(result->cost.cpu_s, 0.0);
  EXPECT_GT(result->cost.peak_memory_bytes, 0U);
}

TEST_F(TaskProcessTest, PassesOnWhichBlobIsToBlame) {
  const Digest digest = *blobs_.Put("x");
  const absl::Status error = RunSpec({.stage = "blame", .inputs = {digest}}).status();
  EXPECT_TRUE(absl::IsDataLoss(error));
  EXPECT_EQ(error.message(), "no number");
  EXPECT_EQ(BlobToBlame(error), digest);
}

TEST_F(TaskProcessTest, PassesOnErrorsOfStagesAndBlobs) {
  EXPECT_TRUE(absl::IsUnimplemented(Run("juggle").status()));
  const TaskSpec lost{.stage = "copy", .inputs = {DigestOf("nobody has this")}};
  EXPECT_TRUE(absl::IsNotFound(RunSpec(lost).status()));
}

TEST_F(TaskProcessTest, ACrashEndsTheAttemptAndTheNextTaskRuns) {
  const std::string first = TextOf("pid");
  for (const int signal : {SIGABRT, SIGSEGV, SIGKILL}) {
    const absl::Status status = Run("die", std::to_string(signal)).status();
    EXPECT_TRUE(absl::IsAborted(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr("signal " + std::to_string(signal)));
    EXPECT_NE(TextOf("pid"), first);
  }
  EXPECT_THAT(std::string(Run("leave").status().message()), HasSubstr("exit code 7"));
}

TEST_F(TaskProcessTest, AProcessThatDiedBetweenTasksIsReplaced) {
  const pid_t first = std::stoi(TextOf("pid"));
  ::kill(first, SIGKILL);
  siginfo_t info{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(first), &info, WEXITED | WNOWAIT), 0);
  EXPECT_NE(TextOf("pid"), std::to_string(first));
}

TEST_F(TaskProcessTest, StopsATaskThatIsToldTo) {
  const std::string pid = TextOf("pid");
  std::stop_source stop;
  const std::jthread later([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  EXPECT_TRUE(absl::IsCancelled(Run("wait", "", {.stop = stop.get_token()}).status()));
  EXPECT_EQ(TextOf("pid"), pid);
}

/// What a process has before it does anything; with a sanitizer that is its shadow of all memory.
uint64_t DataBytes() {
  std::istringstream status(testing::ReadAll("/proc/self/status"));
  uint64_t data_kb = 0;
  for (std::string word; status >> word && word != "VmData:";) {
  }
  status >> data_kb;
  return data_kb << 10;
}

class ThriftyTest : public TaskProcessTest {
 protected:
  ThriftyTest() : TaskProcessTest({.memory_bytes = kMemoryLimit}) {}
};

TEST_F(ThriftyTest, LacksMemoryBeyondItsLimit) {
  if (DataBytes() > kMemoryLimit) GTEST_SKIP() << "a sanitizer's shadow is beyond any limit";
  const std::string pid = TextOf("pid");
  EXPECT_TRUE(absl::IsResourceExhausted(Run("eat").status()));
  EXPECT_EQ(TextOf("pid"), pid);
}

TEST_F(TaskProcessTest, LeavesItToTheWorkerWhatComesOfASignalToEnd) {
  const std::string pid = TextOf("pid");
  ::kill(std::stoi(pid), SIGTERM);
  ::kill(std::stoi(pid), SIGINT);
  EXPECT_EQ(TextOf("pid"), pid);
}

TEST_F(TaskProcessTest, OpensNoSockets) { EXPECT_EQ(TextOf("socket"), std::strerror(EACCES)); }

TEST_F(TaskProcessTest, IsTakenFirstWhenMemoryRunsOut) {
  const std::string pid = TextOf("pid");
  EXPECT_EQ(testing::ReadAll("/proc/" + pid + "/oom_score_adj"), "1000\n");
}

TEST(TaskProcess, DiesWithTheThreadThatStartedIt) {
  testing::MemoryBlobs blobs;
  BlobCache cache(blobs, 1000, {});
  TaskBlobs task_blobs(cache);
  const SteadyClock clock;
  TaskProcess process({}, clock);
  std::thread([&] { ASSERT_TRUE(process.Run({.stage = "pid"}, task_blobs, {}).ok()); }).join();
  siginfo_t info{};
  EXPECT_TRUE(testing::WaitUntil(
      [&info] {
        return ::waitid(P_ALL, 0, &info, WEXITED | WNOWAIT | WNOHANG) == 0 && info.si_pid;
      },
      20.0));
  EXPECT_EQ(info.si_status, SIGKILL);
}

class ImpatientTest : public TaskProcessTest {
 protected:
  ImpatientTest() : TaskProcessTest({.stall_s = 1.0, .total_s = 4.0, .stop_grace_s = 0.1}) {}
};

TEST_F(ImpatientTest, KillsATaskThatHangs) {
  const absl::Status status = Run("hang").status();
  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("no sign of life"));
  EXPECT_EQ(TextOf("compute", "0"), "computed");
}

TEST_F(ImpatientTest, LetsATaskComputeThatLooksWhetherItIsToStop) {
  EXPECT_EQ(TextOf("compute", "2.5"), "computed");
}

TEST_F(ImpatientTest, KillsATaskThatNeverEnds) {
  const absl::Status status = Run("compute", "1000").status();
  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("longer than 4 s"));
}

TEST_F(ImpatientTest, KillsATaskThatDoesNotStopWhenToldTo) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(absl::IsCancelled(Run("hang", "", {.stop = stop.get_token()}).status()));
}

class UnhurriedTest : public TaskProcessTest {
 protected:
  UnhurriedTest() : TaskProcessTest({.stall_s = 2.0}) {}
};

TEST_F(UnhurriedTest, KillsATaskThatSpins) {
  const absl::Status status = Run("spin").status();
  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("it spun"));
}

int BeATaskProcess(int argc, char** argv) {
  const testing::StageMap stages = Stages();
  const SteadyClock clock;
  const bool is_limited = argc > 3;
  ConfineProcess(is_limited ? std::stoull(argv[3]) : 0);
  ServeTasks(FileDescriptor(kChannelDescriptor), testing::LookupIn(stages), clock);
  return 0;
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "exec-tasks") return orbweave::BeATaskProcess(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
