// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What every way to a coordinator promises: the object itself, and a client and a server with a
// unix socket or a TCP port between them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <future>
#include <limits>
#include <memory>
#include <stop_token>
#include <thread>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "core/pipeline/build_version.h"
#include "core/pipeline/damaged_blob.h"
#include "tests/support/command.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"
#include "worker/grpc_coordinator_client.h"
#include "worker/peak_memory.h"
#include "worker/task_runner.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using testing::FindToyPlan;
using ::testing::HasSubstr;
using testing::LookupIn;
using testing::PrepareToyJob;
using testing::TemporaryFolder;
using testing::ToyAnswer;
using testing::ToyStages;
using testing::WaitForEnd;

enum class Way { kDirect, kUnixSocket, kLoopback };

class CoordinatorContract : public ::testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    auto opened =
        Coordinator::Open({.state_dir = folder_ / "state", .find_plan = FindToyPlan}, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
    if (GetParam() == Way::kDirect) return;
    const std::string address =
        GetParam() == Way::kUnixSocket ? "unix:" + (folder_ / "s") : "127.0.0.1:0";
    const FileRoots roots = {{"data", folder_.Path()}};
    auto server = GrpcServer::Start(*coordinator_, address, {.roots = roots});
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    client_ =
        std::make_unique<GrpcCoordinatorClient>(server_->address(), ClientOptions{.roots = roots});
  }

  void TearDown() override {
    if (coordinator_) coordinator_->BeginShutdown();
  }

  CoordinatorApi& Api() { return client_ ? static_cast<CoordinatorApi&>(*client_) : *coordinator_; }

  static WorkerInfo Worker(const std::string& name) {
    return {.name = name, .version = std::string(BuildVersion()), .slots = 2};
  }

  Digest Submit(const std::string& numbers) {
    const auto job = PrepareToyJob(Api(), numbers);
    ORBWEAVE_CHECK(job.ok());
    const auto id = Api().SubmitJob(*job);
    ORBWEAVE_CHECK(id.ok());
    return *id;
  }

  Lease MustLease(uint64_t session) {
    const auto lease = Api().LeaseTask(session, 1, 10.0);
    ORBWEAVE_CHECK(lease.ok() && lease->has_value());
    return **lease;
  }

  absl::Status Do(uint64_t session, const Lease& lease) {
    const auto result = RunTask(LookupIn(stages_), lease.spec, Api(), {}, clock_);
    ORBWEAVE_CHECK(result.ok());
    return Api().CompleteTask(session, lease, *result);
  }

  TemporaryFolder folder_;
  SteadyClock clock_;
  testing::StageMap stages_ = ToyStages();
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<GrpcServer> server_;
  std::unique_ptr<GrpcCoordinatorClient> client_;
};

TEST_P(CoordinatorContract, AWorkerThatIsDrainedGetsNoMoreTasks) {
  Submit("1");
  const auto joined = Api().Join(Worker("w"));
  ASSERT_TRUE(joined.ok());
  const Lease lease = MustLease(joined->session);
  EXPECT_THAT(*Api().DrainWorkers("w"), ElementsAre("w"));
  EXPECT_TRUE(absl::IsCancelled(Api().LeaseTask(joined->session, 0, 10.0).status()));
  EXPECT_TRUE(Do(joined->session, lease).ok()) << "it may finish what it has";
  EXPECT_TRUE(absl::IsNotFound(Api().DrainWorkers("stranger").status()));
}

TEST_P(CoordinatorContract, ANameThatBeginsSeveralDrainsThemOnlyWithAStar) {
  for (const char* name : {"node/a", "node/b", "other"}) ASSERT_TRUE(Api().Join(Worker(name)).ok());
  EXPECT_TRUE(absl::IsInvalidArgument(Api().DrainWorkers("node").status()));
  EXPECT_TRUE(absl::IsNotFound(Api().DrainWorkers("nobody*").status()));
  EXPECT_THAT(*Api().DrainWorkers("node/*"), ElementsAre("node/a", "node/b"));
  EXPECT_THAT(*Api().DrainWorkers("oth"), ElementsAre("other"));
}

TEST_P(CoordinatorContract, WhatLeftABlobThatCannotBeReadIsDoneAgain) {
  Submit("3");
  const uint64_t session = Api().Join(Worker("w"))->session;
  ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const Lease square = MustLease(session);
  ASSERT_EQ(square.spec.stage, "square");
  ASSERT_TRUE(Do(session, square).ok());
  const Lease sum = MustLease(session);
  ASSERT_EQ(sum.spec.stage, "sum");
  const absl::Status damaged = BlameBlob(absl::DataLossError("no number"), DigestOf("9"));
  ASSERT_TRUE(Api().FailTask(session, sum, damaged).ok());
  EXPECT_EQ(MustLease(session).task, square.task);
}

TEST_P(CoordinatorContract, ASlotHasOneQuestionAtATime) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  auto before =
      std::async(std::launch::async, [&] { return Api().LeaseTask(session, 0, 60.0).status(); });
  const auto is_over = [&] {
    const auto lease = Api().LeaseTask(session, 0, 0.0);
    EXPECT_TRUE(lease.ok()) << lease.status();
    return before.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  EXPECT_TRUE(testing::WaitUntil(is_over, 30.0)) << "it was asked again";
  EXPECT_TRUE(absl::IsAborted(before.get()));
}

TEST_P(CoordinatorContract, AQuestionOfAnotherSlotIsAnother) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  auto other =
      std::async(std::launch::async, [&] { return Api().LeaseTask(session, 1, 0.5).status(); });
  EXPECT_TRUE(Api().LeaseTask(session, 0, 0.5).ok());
  EXPECT_TRUE(other.get().ok());
}

TEST_P(CoordinatorContract, KnowsNoSlotThatItsWorkerHasNot) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  EXPECT_TRUE(absl::IsInvalidArgument(Api().LeaseTask(session, 2, 0.0).status()));
}

TEST_P(CoordinatorContract, AnEarlierSessionsQuestionsEndWhenItsWorkerJoinsAnew) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  auto before =
      std::async(std::launch::async, [&] { return Api().LeaseTask(session, 0, 60.0).status(); });
  ASSERT_TRUE(Api().Join(Worker("w")).ok());
  EXPECT_TRUE(absl::IsNotFound(before.get()));
}

TEST_P(CoordinatorContract, ListsWorkersWithoutAJob) {
  ASSERT_TRUE(Api().Join(Worker("w")).ok());
  const auto workers = Api().ListWorkers();
  ASSERT_TRUE(workers.ok());
  ASSERT_EQ(workers->size(), 1U);
  EXPECT_EQ(workers->at(0).name, "w");
}

/// As long as a description may be: all of them are more than one message holds.
TEST_P(CoordinatorContract, ListsJobsHoweverLargeTheyAreTogether) {
  constexpr int kJobs = 600;
  const JobSpec job = *PrepareToyJob(Api(), "1");
  for (int i = 0; i < kJobs; ++i) {
    JobSpec large = job;
    large.label.assign(1024, 'x');
    large.options_text.assign(16 * 1024 - 8, ' ');
    large.options_text += std::to_string(i);
    ASSERT_TRUE(Api().SubmitJob(large).ok());
  }
  const auto jobs = Api().ListJobs();
  ASSERT_TRUE(jobs.ok()) << jobs.status();
  EXPECT_EQ(jobs->size(), kJobs);
}

TEST_P(CoordinatorContract, TheReasonOfAFailureIsCut) {
  const Digest job = Submit("1");
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Lease lease = MustLease(session);
  const absl::Status wordy = absl::InvalidArgumentError(std::string(1 << 20, 'x'));
  ASSERT_TRUE(Api().FailTask(session, lease, wordy).ok());
  EXPECT_EQ(Api().GetJob(job)->state, JobState::kFailed);
  EXPECT_LT(Api().GetJob(job)->error.size(), 10'000U);
}

TEST_P(CoordinatorContract, AResultThatNoMessageHoldsIsRefused) {
  Submit("1");
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Lease lease = MustLease(session);
  const TaskResult wordy{.report_json = std::string((1 << 20) + 1, ' ')};
  EXPECT_TRUE(absl::IsInvalidArgument(Api().CompleteTask(session, lease, wordy)));
}

TEST_P(CoordinatorContract, RunsAJobFromSubmissionToAnswer) {
  const Digest job = Submit("1 2 3");
  const auto joined = Api().Join(Worker("w"));
  ASSERT_TRUE(joined.ok());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(Do(joined->session, MustLease(joined->session)).ok());
  const auto status = WaitForEnd(Api(), job);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status->state, JobState::kDone);
  EXPECT_EQ(status->spec.label, "squares of 1 2 3");
  ASSERT_EQ(status->stages.size(), 3U);
  EXPECT_EQ(status->stages[1].stage, "square");
  EXPECT_EQ(status->stages[1].tasks_done, 3U);
  const auto workers = Api().ListWorkers();
  ASSERT_EQ(workers->size(), 1U);
  EXPECT_EQ(workers->at(0).tasks_done, 5U);
  EXPECT_EQ(workers->at(0).slots, 2U);
  EXPECT_TRUE(workers->at(0).alive);
  EXPECT_EQ(*ToyAnswer(Api(), job), "14");
  EXPECT_EQ(*Api().CountWantedSlots(), 3U) << "so many tasks there were within the last minute";
}

TEST_P(CoordinatorContract, ListsOutcomesByStageAndPartAndTimings) {
  const Digest job = Submit("4 5");
  const uint64_t session = Api().Join(Worker("w"))->session;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const auto outcomes = Api().GetOutcomes(job);
  ASSERT_TRUE(outcomes.ok());
  std::vector<std::string> names;
  for (const TaskOutcome& outcome : *outcomes)
    names.push_back(outcome.stage + std::to_string(outcome.part));
  EXPECT_THAT(names, ElementsAre("split0", "square0", "square1", "sum0"));
  EXPECT_THAT(outcomes->at(1).result.outputs, ElementsAre(DigestOf("16")));
  const auto timings = Api().GetTimings(job);
  ASSERT_TRUE(timings.ok());
  ASSERT_EQ(timings->size(), 4U);
  EXPECT_EQ(timings->at(0).worker, "w");
  EXPECT_EQ(timings->at(0).slot, 1U);
  EXPECT_TRUE(timings->at(0).ok);
  EXPECT_LE(timings->at(0).start_s, timings->at(0).end_s);
}

TEST_P(CoordinatorContract, ListsWhatTasksTook) {
  const Digest job = Submit("4");
  const uint64_t session = Api().Join(Worker("w"))->session;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Do(session, MustLease(session)).ok());
  const auto costs = Api().GetCosts(job);
  ASSERT_TRUE(costs.ok());
  ASSERT_EQ(costs->size(), 3U);
  EXPECT_EQ(costs->at(1).run, 1U);
  EXPECT_EQ(costs->at(1).stage, "square");
  EXPECT_EQ(costs->at(1).part, 0U);
  EXPECT_EQ(costs->at(1).cost.bytes_in, 1U) << "the text 4";
  EXPECT_EQ(costs->at(1).cost.bytes_out, 2U) << "the text 16";
  EXPECT_GT(costs->at(1).cost.peak_memory_bytes, 0U);
}

TEST_P(CoordinatorContract, KeepsBlobsOfEverySize) {
  for (const size_t size : {0UL, 1UL, 524'288UL, 524'289UL, 3'000'001UL}) {
    std::string bytes(size, 'x');
    for (size_t i = 0; i < size; i += 97) bytes[i] = static_cast<char>(i);
    const auto digest = Api().Put(bytes);
    ASSERT_TRUE(digest.ok()) << digest.status();
    EXPECT_EQ(*digest, DigestOf(bytes));
    const auto back = Api().Get(*digest);
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_TRUE(*back == bytes) << size;
  }
}

TEST_P(CoordinatorContract, HoldsOnlyPiecesOfALargeBlob) {
  constexpr uint64_t kPieces = 512;
  const std::string piece(kPieceBytes, 'x');
  DigestBuilder name;
  for (uint64_t i = 0; i < kPieces; ++i) name.Add(piece);
  const Digest digest = name.Finish();
  uint64_t given = 0;
  uint64_t taken_bytes = 0;
  RestartPeakMemory();
  const uint64_t before_bytes = PeakMemoryBytes();
  const auto next = [&]() -> absl::StatusOr<std::string_view> {
    return given++ < kPieces ? std::string_view(piece) : std::string_view();
  };
  const absl::Status written = Api().Write(digest, kPieces * piece.size(), next);
  ASSERT_TRUE(written.ok()) << written;
  const absl::Status read = Api().Read(digest, [&taken_bytes](std::string_view got) {
    taken_bytes += got.size();
    return absl::OkStatus();
  });
  ASSERT_TRUE(read.ok()) << read;
  EXPECT_EQ(taken_bytes, kPieces * piece.size());
  EXPECT_LT(PeakMemoryBytes() - before_bytes, taken_bytes / 2);
}

TEST_P(CoordinatorContract, StoresNoOtherPiecesThanThoseThatWereNamed) {
  const Digest digest = DigestOf("precious");
  EXPECT_FALSE(Api().Write(digest, 8, PiecesOf("presious")).ok());
  EXPECT_FALSE(Api().Write(digest, 9, PiecesOf("precious")).ok());
  EXPECT_THAT(*Api().StatBlobs({digest, DigestOf("presious")}), ElementsAre(false, false));
  EXPECT_TRUE(Api().Write(digest, 8, PiecesOf("precious")).ok());
  EXPECT_EQ(*Api().Get(digest), "precious");
}

TEST_P(CoordinatorContract, WhoCannotTakeOrGiveAPieceSaysWhy) {
  const Digest digest = *Api().Put(std::string(3 * kPieceBytes, 'x'));
  int pieces = 0;
  const auto full = [&pieces](std::string_view) {
    return ++pieces < 2 ? absl::OkStatus() : absl::ResourceExhaustedError("full");
  };
  EXPECT_TRUE(absl::IsResourceExhausted(Api().Read(digest, full)));
  const auto lost = []() -> absl::StatusOr<std::string_view> {
    return absl::NotFoundError("the file is gone");
  };
  EXPECT_TRUE(absl::IsNotFound(Api().Write(DigestOf("precious"), 8, lost)));
}

TEST_P(CoordinatorContract, SaysWhichBlobsAreStored) {
  const Digest stored = *Api().Put("stored");
  const auto answer = Api().StatBlobs({DigestOf("missing"), stored, DigestOf("absent")});
  ASSERT_TRUE(answer.ok());
  EXPECT_THAT(*answer, ElementsAre(false, true, false));
  EXPECT_TRUE(Api().StatBlobs({})->empty());
  EXPECT_TRUE(absl::IsNotFound(Api().Get(DigestOf("missing")).status()));
}

TEST_P(CoordinatorContract, CollectsGarbageAndForgetsJobs) {
  const Digest job = Submit("1");
  const Digest stray = *Api().Put("stray");
  EXPECT_EQ(Api().CollectGarbage({})->recent_blobs, 1U);
  EXPECT_EQ(Api().CollectGarbage({.unused_s = 0.0, .dry_run = true})->removed_bytes, 5U);
  const auto report = Api().CollectGarbage({.unused_s = 0.0});
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->removed_blobs, 1U);
  EXPECT_EQ(report->needed_blobs, 1U) << "the job's input";
  EXPECT_EQ(report->needed_bytes, 1U);
  EXPECT_FALSE(Api().StatBlobs({stray})->at(0));
  EXPECT_TRUE(absl::IsFailedPrecondition(Api().ForgetJob(job)));
  ASSERT_TRUE(Api().CancelJob(job).ok());
  EXPECT_TRUE(Api().ForgetJob(job).ok());
  EXPECT_TRUE(absl::IsNotFound(Api().ForgetJob(job)));
  EXPECT_EQ(Api().CollectGarbage({.unused_s = 0.0})->removed_blobs, 1U);
  EXPECT_TRUE(absl::IsInvalidArgument(Api().CollectGarbage({.unused_s = -1.0}).status()));
}

TEST_P(CoordinatorContract, LinksAFileWithoutCopyingIt) {
  const std::string path = folder_ / "image.jpg";
  std::ofstream(path) << "pixels";
  ASSERT_TRUE(Api().LinkFile(DigestOf("pixels"), path).ok());
  EXPECT_EQ(*Api().Get(DigestOf("pixels")), "pixels");
  EXPECT_TRUE(absl::IsDataLoss(Api().LinkFile(DigestOf("others"), path)));
  EXPECT_TRUE(absl::IsNotFound(Api().LinkFile(DigestOf("pixels"), path + ".gone")));
}

TEST_P(CoordinatorContract, ADamagedBlobIsDataLoss) {
  const Digest digest = *Api().Put("precious");
  const std::string hex = digest.ToHex();
  std::ofstream(folder_ / ("state/blobs/" + hex.substr(0, 2) + "/" + hex)) << "other";
  EXPECT_TRUE(absl::IsDataLoss(Api().Get(digest).status()));
}

TEST_P(CoordinatorContract, RefusesAWorkerOfAnotherVersionAndNamesBoth) {
  WorkerInfo old = Worker("veteran");
  old.version = "0.0.1";
  const auto joined = Api().Join(old);
  EXPECT_TRUE(absl::IsFailedPrecondition(joined.status()));
  const std::string message(joined.status().message());
  EXPECT_THAT(message, HasSubstr("veteran"));
  EXPECT_THAT(message, HasSubstr("0.0.1"));
  EXPECT_THAT(message, HasSubstr(std::string(BuildVersion())));
}

TEST_P(CoordinatorContract, KnowsOnlyItsSessionsAndJobs) {
  const uint64_t stranger = 12345;
  EXPECT_TRUE(absl::IsNotFound(Api().LeaseTask(stranger, 0, 0.0).status()));
  EXPECT_TRUE(absl::IsNotFound(Api().Heartbeat(stranger, {}).status()));
  EXPECT_TRUE(absl::IsNotFound(Api().GetJob(DigestOf("job")).status()));
  EXPECT_TRUE(absl::IsNotFound(Api().CancelJob(DigestOf("job"))));
  EXPECT_TRUE(absl::IsNotFound(Api().GetOutcomes(DigestOf("job")).status()));
  EXPECT_TRUE(absl::IsNotFound(Api().GetTimings(DigestOf("job")).status()));
  EXPECT_TRUE(absl::IsNotFound(Api().GetCosts(DigestOf("job")).status()));
  EXPECT_TRUE(Api().ListJobs()->empty());
}

TEST_P(CoordinatorContract, RefusesAJobOfUnknownKindOrWithoutItsInput) {
  EXPECT_TRUE(absl::IsInvalidArgument(Api().SubmitJob({.kind = "dense"}).status()));
  EXPECT_TRUE(absl::IsNotFound(
      Api().SubmitJob({.kind = "toy", .inputs = {DigestOf("never put")}}).status()));
}

TEST_P(CoordinatorContract, KeepsWhoAskedForAJobOutOfItsId) {
  JobSpec job = *PrepareToyJob(Api(), "1");
  const Digest id = job.Id();
  job.traceparent = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
  EXPECT_EQ(job.Id(), id);
  ASSERT_EQ(*Api().SubmitJob(job), id);
  EXPECT_EQ(Api().GetJob(id)->spec.traceparent, job.traceparent);
  JobSpec wrong = *PrepareToyJob(Api(), "2");
  wrong.traceparent = "00-0-0-0";
  EXPECT_TRUE(absl::IsInvalidArgument(Api().SubmitJob(wrong).status()));
}

TEST_P(CoordinatorContract, RefusesAJobWhoseDescriptionWouldFillTheListOfAll) {
  const JobSpec job = *PrepareToyJob(Api(), "1");
  JobSpec labelled = job;
  labelled.label = std::string(4'500'000, 'a');
  EXPECT_TRUE(absl::IsInvalidArgument(Api().SubmitJob(labelled).status()));
  JobSpec optioned = job;
  optioned.options_text = "toy.slow=false\n" + std::string(100'000, '\n');
  EXPECT_TRUE(absl::IsInvalidArgument(Api().SubmitJob(optioned).status()));
  EXPECT_TRUE(Api().ListJobs()->empty());
  EXPECT_TRUE(Api().SubmitJob(job).ok());
}

TEST_P(CoordinatorContract, WaitsForWorkNoLongerThanAsked) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  const double start_s = clock_.NowSeconds();
  const auto lease = Api().LeaseTask(session, 0, 0.2);
  ASSERT_TRUE(lease.ok());
  EXPECT_FALSE(lease->has_value());
  EXPECT_GE(clock_.NowSeconds() - start_s, 0.19);
}

TEST_P(CoordinatorContract, AWaitIsANumberOfSeconds) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  using Limits = std::numeric_limits<double>;
  for (const double wait_s : {Limits::quiet_NaN(), Limits::infinity(), -1.0})
    EXPECT_TRUE(absl::IsInvalidArgument(Api().LeaseTask(session, 0, wait_s).status())) << wait_s;
}

TEST_P(CoordinatorContract, WhoHasLeftIsGivenNothing) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  std::stop_source left;
  auto waiting = std::async(std::launch::async, [&] {
    return Api().LeaseTask(session, 0, 30.0, left.get_token()).status();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  left.request_stop();
  EXPECT_TRUE(absl::IsCancelled(waiting.get()));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // until the other end knows
  Submit("1");
  EXPECT_EQ(MustLease(session).epoch & 0xffffffffU, 1U) << "the first lease of all";
}

TEST_P(CoordinatorContract, CompletingTwiceIsHarmless) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  Submit("1");
  const Lease lease = MustLease(session);
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_TRUE(Do(session, lease).ok());
}

TEST_P(CoordinatorContract, RefusesAResultUnderAStaleEpoch) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  Submit("1");
  const Lease lease = MustLease(session);
  Lease stale = lease;
  stale.epoch -= 1;
  EXPECT_TRUE(absl::IsFailedPrecondition(Do(session, stale)));
  EXPECT_TRUE(
      absl::IsFailedPrecondition(Api().FailTask(session, stale, absl::InternalError("late"))));
  EXPECT_TRUE(Do(session, lease).ok());
}

TEST_P(CoordinatorContract, AReturnedTaskIsGivenOutAgainUnderANewEpoch) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  Submit("1");
  const Lease first = MustLease(session);
  ASSERT_TRUE(Api().FailTask(session, first, absl::CancelledError("going down")).ok());
  const Lease second = MustLease(session);
  EXPECT_EQ(second.task, first.task);
  EXPECT_GT(second.epoch, first.epoch);
}

TEST_P(CoordinatorContract, LeavingGivesTasksBack) {
  const uint64_t leaver = Api().Join(Worker("leaver"))->session;
  Submit("1");
  const Lease lease = MustLease(leaver);
  ASSERT_TRUE(Api().Leave(leaver).ok());
  EXPECT_TRUE(absl::IsNotFound(Api().LeaseTask(leaver, 0, 0.0).status()));
  EXPECT_EQ(MustLease(Api().Join(Worker("stayer"))->session).task, lease.task);
}

TEST_P(CoordinatorContract, APermanentErrorFailsTheJobWithItsText) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Digest job = Submit("1");
  ASSERT_TRUE(
      Api().FailTask(session, MustLease(session), absl::InvalidArgumentError("not a number")).ok());
  const auto status = Api().GetJob(job);
  EXPECT_EQ(status->state, JobState::kFailed);
  EXPECT_THAT(status->error, HasSubstr("stage split, part 0"));
  EXPECT_THAT(status->error, HasSubstr("not a number"));
}

TEST_P(CoordinatorContract, ProgressOfRunningTasksIsSeen) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Digest job = Submit("1");
  const Lease lease = MustLease(session);
  ASSERT_TRUE(Api().Heartbeat(session, {{lease.task, lease.epoch, {1, 4, "numbers"}}}).ok());
  EXPECT_EQ(Api().GetJob(job)->stages[0].tasks_running, 1U);
  EXPECT_DOUBLE_EQ(Api().GetJob(job)->stages[0].fraction_running, 0.25);
}

TEST_P(CoordinatorContract, CancellingTakesTheTasksBack) {
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Digest job = Submit("1");
  const Lease lease = MustLease(session);
  ASSERT_TRUE(Api().CancelJob(job).ok());
  EXPECT_EQ(Api().GetJob(job)->state, JobState::kCancelled);
  EXPECT_THAT(Api().Heartbeat(session, {{lease.task, lease.epoch, {}}})->cancelled,
              ElementsAre(lease.task));
}

TEST_P(CoordinatorContract, TellsHowManyTasksAWorkerHolds) {
  Submit("1");
  const uint64_t session = Api().Join(Worker("w"))->session;
  const Lease lease = MustLease(session);
  EXPECT_EQ(Api().ListWorkers()->at(0).tasks_running, 1U);
  EXPECT_TRUE(Do(session, lease).ok());
  EXPECT_EQ(Api().ListWorkers()->at(0).tasks_running, 0U);
}

TEST_P(CoordinatorContract, SubmittingTheSameJobJoinsIt) {
  const Digest job = Submit("1 2");
  EXPECT_EQ(Submit("1 2"), job);
  EXPECT_NE(Submit("1 2 3"), job);
  EXPECT_EQ(Api().ListJobs()->size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Ways,
                         CoordinatorContract,
                         ::testing::Values(Way::kDirect, Way::kUnixSocket, Way::kLoopback),
                         [](const auto& way) {
                           switch (way.param) {
                             case Way::kDirect:
                               return "Direct";
                             case Way::kUnixSocket:
                               return "UnixSocket";
                             case Way::kLoopback:
                               break;
                           }
                           return "Loopback";
                         });

}  // namespace
}  // namespace orbweave
