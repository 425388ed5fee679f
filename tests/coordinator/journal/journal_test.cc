// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The contract of a journal, held against every kind of database.

#include "coordinator/journal/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "coordinator/journal/postgres_journal.h"
#include "coordinator/journal/sqlite_journal.h"
#include "tests/support/command.h"
#include "tests/support/postgres_server.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

const Digest kTask = DigestOf("task");
const Digest kJob = DigestOf("job");

Attempt MakeAttempt(uint64_t epoch, const Digest& task = kTask) {
  return {.epoch = epoch,
          .task = task,
          .job = kJob,
          .stage = "square",
          .part = 7,
          .worker = "w",
          .slot = 1};
}

/// Where journals of one kind are kept.
class Store {
 public:
  virtual ~Store() = default;
  [[nodiscard]] virtual absl::StatusOr<std::unique_ptr<Journal>> Open() = 0;
};

class SqliteStore final : public Store {
 public:
  [[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> Open() override {
    return OpenSqliteJournal(folder_ / "journal.db");
  }

 private:
  TemporaryFolder folder_;
};

/// The server of this test program, started when it is first asked for; nullptr: not installed.
testing::PostgresServer* Server() {
  static const std::unique_ptr<testing::PostgresServer> server = testing::PostgresServer::Start();
  return server.get();
}

class PostgresStore final : public Store {
 public:
  PostgresStore() : url_(Server()->MakeDatabase("test" + std::to_string(++count_))) {}
  [[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> Open() override {
    return OpenPostgresJournal(url_);
  }

 private:
  static inline int count_ = 0;
  std::string url_;
};

using MakeStore = std::unique_ptr<Store> (*)();

class JournalContract : public ::testing::TestWithParam<MakeStore> {
 protected:
  void SetUp() override {
    store_ = GetParam()();
    if (store_ == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
    Reopen();
  }

  void Reopen() {
    journal_.reset();
    auto opened = store_->Open();
    ASSERT_TRUE(opened.ok()) << opened.status();
    journal_ = *std::move(opened);
  }

  std::unique_ptr<Store> store_;
  std::unique_ptr<Journal> journal_;
};

TEST_P(JournalContract, CountsItsGenerations) {
  EXPECT_EQ(journal_->generation(), 1U);
  Reopen();
  EXPECT_EQ(journal_->generation(), 2U);
}

TEST_P(JournalContract, TriesToSaveAsOftenAsItIsAskedTo) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(journal_->TrySave().ok());
  Reopen();
  EXPECT_TRUE(journal_->TrySave().ok());
  EXPECT_EQ(journal_->generation(), 2U);
}

TEST_P(JournalContract, RemembersResultsAcrossGenerations) {
  const TaskResult result{.outputs = {DigestOf("o"), DigestOf("p")},
                          .recipes = {DigestOf("r")},
                          .report_json = "{\"why\":\"\xc3\xa4\"}",
                          .cost = {.cpu_s = 1.5, .bytes_in = uint64_t{5} << 40}};
  ASSERT_TRUE(journal_->SaveResult(1, kTask, result).ok());
  Reopen();
  const auto loaded = journal_->LoadResults({DigestOf("other"), kTask});
  ASSERT_TRUE(loaded.ok()) << loaded.status();
  ASSERT_EQ(loaded->size(), 2U);
  EXPECT_FALSE(loaded->at(0).has_value());
  ASSERT_TRUE(loaded->at(1).has_value());
  const TaskResult& found = *loaded->at(1);
  EXPECT_EQ(found.outputs, result.outputs);
  EXPECT_EQ(found.recipes, result.recipes);
  EXPECT_EQ(found.report_json, result.report_json);
  EXPECT_DOUBLE_EQ(found.cost.cpu_s, 1.5);
  EXPECT_EQ(found.cost.bytes_in, uint64_t{5} << 40);
}

TEST_P(JournalContract, TheLastResultOfATaskCounts) {
  ASSERT_TRUE(journal_->SaveResult(1, kTask, {.outputs = {DigestOf("lost blob")}}).ok());
  ASSERT_TRUE(journal_->SaveResult(2, kTask, {.outputs = {DigestOf("o")}}).ok());
  EXPECT_THAT(journal_->LoadResults({kTask})->at(0)->outputs, ElementsAre(DigestOf("o")));
}

TEST_P(JournalContract, LooksUpAnyNumberOfTasksInTheirOrder) {
  std::vector<Digest> tasks;
  for (int i = 0; i < 150; ++i) {
    tasks.push_back(DigestOf("task" + std::to_string(i)));
    if (i % 3 != 0) {
      ASSERT_TRUE(journal_->SaveResult(1, tasks.back(), {.outputs = {tasks.back()}}).ok());
    }
  }
  const auto found = journal_->LoadResults(tasks);
  ASSERT_TRUE(found.ok()) << found.status();
  ASSERT_EQ(found->size(), tasks.size());
  for (size_t i = 0; i < tasks.size(); ++i) {
    ASSERT_EQ(found->at(i).has_value(), i % 3 != 0) << i;
    if (!found->at(i)) continue;
    EXPECT_THAT(found->at(i)->outputs, ElementsAre(tasks[i]));
  }
  EXPECT_TRUE(journal_->LoadResults({})->empty());
}

TEST_P(JournalContract, ListsJobsAsTheyWereSubmitted) {
  for (uint64_t number = 5; number > 0; --number) {
    const JobSpec spec{.kind = "k" + std::to_string(number), .inputs = {kTask}, .label = "l"};
    ASSERT_TRUE(journal_->SaveJob({.spec = spec, .number = number}).ok());
  }
  const JobSpec third{.kind = "k3", .inputs = {kTask}, .label = "l"};
  ASSERT_TRUE(
      journal_
          ->SaveJob({.spec = third, .state = JobState::kFailed, .error = "it's why", .number = 3})
          .ok());
  Reopen();
  const auto jobs = journal_->LoadJobs();
  ASSERT_TRUE(jobs.ok()) << jobs.status();
  ASSERT_EQ(jobs->size(), 5U);
  for (uint64_t i = 0; i < 5; ++i) EXPECT_EQ((*jobs)[i].spec.kind, "k" + std::to_string(i + 1));
  EXPECT_EQ((*jobs)[2].spec.Id(), third.Id());
  EXPECT_EQ((*jobs)[2].spec.label, "l");
  EXPECT_EQ((*jobs)[2].state, JobState::kFailed);
  EXPECT_EQ((*jobs)[2].error, "it's why");
  EXPECT_EQ((*jobs)[1].state, JobState::kRunning);
}

TEST_P(JournalContract, AnAttemptIsOpenUntilItsResultOrItsEnd) {
  const uint64_t big = uint64_t{3} << 32;
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(big + 2, DigestOf("second"))).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(big + 1)).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(big + 3, DigestOf("third"))).ok());
  Reopen();
  auto open = journal_->LoadOpenAttempts();
  ASSERT_TRUE(open.ok()) << open.status();
  ASSERT_EQ(open->size(), 3U);
  EXPECT_EQ(open->at(0).epoch, big + 1);
  EXPECT_EQ(open->at(0).task, kTask);
  EXPECT_EQ(open->at(0).job, kJob);
  EXPECT_EQ(open->at(0).stage, "square");
  EXPECT_EQ(open->at(0).part, 7U);
  EXPECT_EQ(open->at(0).worker, "w");
  EXPECT_EQ(open->at(0).slot, 1U);
  ASSERT_TRUE(journal_->SaveResult(big + 1, kTask, {}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{big + 3, "went silent"}}).ok());
  open = journal_->LoadOpenAttempts();
  ASSERT_EQ(open->size(), 1U);
  EXPECT_EQ(open->at(0).epoch, big + 2);
}

TEST_P(JournalContract, KeepsAttemptsWithWhenAndWhyTheyEnded) {
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(1)).ok());
  ASSERT_TRUE(journal_->SaveEnds({{1, "out of memory"}}).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(2)).ok());
  ASSERT_TRUE(journal_->SaveResult(2, kTask, {}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{2, "too late to matter"}}).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(3)).ok());
  const auto attempts = journal_->LoadAttempts(kTask);
  ASSERT_TRUE(attempts.ok()) << attempts.status();
  ASSERT_EQ(attempts->size(), 3U);
  EXPECT_EQ(attempts->at(0).reason, "out of memory");
  EXPECT_LE(attempts->at(0).started_s, attempts->at(0).ended_s);
  EXPECT_GT(attempts->at(0).started_s, 1.7e9) << "seconds since 1970";
  EXPECT_TRUE(attempts->at(1).ended_s.has_value());
  EXPECT_EQ(attempts->at(1).reason, "");
  EXPECT_FALSE(attempts->at(2).ended_s.has_value());
  EXPECT_TRUE(journal_->LoadAttempts(DigestOf("other"))->empty());
}

TEST_P(JournalContract, TellsWhichAttemptsOfAJobFailedSinceAnEpoch) {
  using absl::StatusCode;
  for (uint64_t epoch = 1; epoch <= 6; ++epoch)
    ASSERT_TRUE(journal_->SaveStart(MakeAttempt(epoch)).ok());
  Attempt other = MakeAttempt(7);
  other.job = DigestOf("other job");
  ASSERT_TRUE(journal_->SaveStart(other).ok());
  ASSERT_TRUE(journal_->SaveEnds({{1, "before", StatusCode::kAborted}}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{2, "given back"}}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{5, "late", StatusCode::kUnavailable}}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{3, "signal 11", StatusCode::kAborted}}).ok());
  ASSERT_TRUE(journal_->SaveResult(4, kTask, {}).ok());
  ASSERT_TRUE(journal_->SaveEnds({{7, "another's", StatusCode::kAborted}}).ok());
  Reopen();
  const auto failures = journal_->LoadFailures(kJob, 1);
  ASSERT_TRUE(failures.ok()) << failures.status();
  ASSERT_EQ(failures->size(), 2U);
  EXPECT_EQ(failures->at(0).task, kTask);
  EXPECT_EQ(failures->at(0).worker, "w");
  EXPECT_EQ(failures->at(0).code, StatusCode::kAborted);
  EXPECT_EQ(failures->at(0).reason, "signal 11");
  EXPECT_EQ(failures->at(1).reason, "late");
  EXPECT_TRUE(journal_->LoadFailures(kJob, 5)->empty());
}

TEST_P(JournalContract, RemembersSinceWhenAJobsFailuresCount) {
  ASSERT_TRUE(journal_->SaveJob({.spec = {.kind = "k"}, .number = 1, .since_epoch = 5}).ok());
  EXPECT_EQ(journal_->LoadJobs()->at(0).since_epoch, 5U);
  const uint64_t big = uint64_t{3} << 32;
  ASSERT_TRUE(journal_->SaveJob({.spec = {.kind = "k"}, .number = 1, .since_epoch = big}).ok());
  Reopen();
  EXPECT_EQ(journal_->LoadJobs()->at(0).since_epoch, big);
}

TEST_P(JournalContract, RemembersWhoIsToBlame) {
  const uint64_t process = ~uint64_t{5};
  ASSERT_TRUE(journal_->SaveBlames({{"v", 1, 1}, {"u", process, 2}}).ok());
  ASSERT_TRUE(journal_->SaveBlames({{"v", 1, 0}, {"u", process, 3}}).ok());
  Reopen();
  const auto blames = journal_->LoadBlames();
  ASSERT_TRUE(blames.ok()) << blames.status();
  ASSERT_EQ(blames->size(), 1U);
  EXPECT_EQ(blames->at(0).worker, "u");
  EXPECT_EQ(blames->at(0).process, process);
  EXPECT_EQ(blames->at(0).blames, 3U);
}

TEST_P(JournalContract, SavingTwiceChangesNothing) {
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(journal_->SaveStart(MakeAttempt(1)).ok());
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(journal_->SaveResult(1, kTask, {}).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(1)).ok());  // does not open it again
  EXPECT_TRUE(journal_->LoadOpenAttempts()->empty());
  EXPECT_EQ(journal_->LoadAttempts(kTask)->size(), 1U);
}

TEST_P(JournalContract, ForgetsAJobWithItsAttemptsAndNothingElse) {
  const JobSpec spec{.kind = "k"};
  ASSERT_TRUE(journal_->SaveJob({.spec = spec, .number = 1}).ok());
  ASSERT_TRUE(journal_->SaveJob({.spec = {.kind = "other"}, .number = 2}).ok());
  Attempt attempt = MakeAttempt(1);
  attempt.job = spec.Id();
  ASSERT_TRUE(journal_->SaveStart(attempt).ok());
  ASSERT_TRUE(journal_->SaveResult(1, kTask, {}).ok());
  ASSERT_TRUE(journal_->SaveStart(MakeAttempt(2)).ok());
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(journal_->ForgetJob(spec.Id()).ok());
  Reopen();
  ASSERT_EQ(journal_->LoadJobs()->size(), 1U);
  EXPECT_EQ(journal_->LoadJobs()->at(0).spec.kind, "other");
  ASSERT_EQ(journal_->LoadAttempts(kTask)->size(), 1U);
  EXPECT_EQ(journal_->LoadAttempts(kTask)->at(0).attempt.job, kJob);
  EXPECT_TRUE(journal_->LoadResults({kTask})->at(0).has_value());
}

TEST_P(JournalContract, SavesManyStartsAtOnce) {
  ASSERT_TRUE(journal_->SaveStarts({}).ok());
  ASSERT_TRUE(journal_->SaveStarts({MakeAttempt(2, DigestOf("second")), MakeAttempt(1)}).ok());
  Reopen();
  const auto open = journal_->LoadOpenAttempts();
  ASSERT_TRUE(open.ok()) << open.status();
  ASSERT_EQ(open->size(), 2U);
  EXPECT_EQ(open->at(0).epoch, 1U);
  EXPECT_EQ(open->at(1).task, DigestOf("second"));
}

TEST_P(JournalContract, ForgetsTheResultOfATask) {
  ASSERT_TRUE(journal_->SaveResult(1, kTask, {.outputs = {DigestOf("o")}}).ok());
  ASSERT_TRUE(journal_->SaveResult(2, DigestOf("other"), {.outputs = {DigestOf("p")}}).ok());
  ASSERT_TRUE(journal_->ForgetResultOf(kTask).ok());
  ASSERT_TRUE(journal_->ForgetResultOf(DigestOf("nobody's")).ok());
  const auto found = journal_->LoadResults({kTask, DigestOf("other")});
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_FALSE(found->at(0).has_value());
  EXPECT_TRUE(found->at(1).has_value());
}

TEST_P(JournalContract, ForgetsTheResultsThatAreGarbage) {
  std::vector<Digest> tasks;
  for (int i = 0; i < 600; ++i) {
    tasks.push_back(DigestOf("task" + std::to_string(i)));
    const std::string report = i % 3 == 0 ? "garbage" : "{}";
    ASSERT_TRUE(journal_->SaveResult(1, tasks.back(), {.report_json = report}).ok());
  }
  EXPECT_EQ(*journal_->ForgetResults([](const Digest&, const TaskResult&) { return false; }), 0U);
  const auto forgotten = journal_->ForgetResults(
      [](const Digest&, const TaskResult& result) { return result.report_json == "garbage"; });
  ASSERT_TRUE(forgotten.ok()) << forgotten.status();
  EXPECT_EQ(*forgotten, 200U);
  const auto found = journal_->LoadResults(tasks);
  for (size_t i = 0; i < tasks.size(); ++i) EXPECT_EQ(found->at(i).has_value(), i % 3 != 0) << i;
}

TEST_P(JournalContract, AResultThatIsSavedMeanwhileIsNotForgotten) {
  ASSERT_TRUE(journal_->SaveResult(1, kTask, {.report_json = "old"}).ok());
  const auto forgotten = journal_->ForgetResults([&](const Digest&, const TaskResult& result) {
    if (result.report_json != "old") return false;
    std::jthread([&] {  // another thread: the one that asks has the reader
      EXPECT_TRUE(journal_->SaveResult(2, kTask, {.report_json = "new"}).ok());
    })
        .join();
    return true;
  });
  ASSERT_TRUE(forgotten.ok()) << forgotten.status();
  EXPECT_EQ(*forgotten, 0U);
  EXPECT_EQ(journal_->LoadResults({kTask})->at(0)->report_json, "new");
}

TEST_P(JournalContract, TakesWritesOfManyThreads) {
  constexpr int kThreads = 8;
  constexpr int kEach = 25;
  const auto task = [](int thread, int i) {
    return DigestOf(std::to_string(thread) + "," + std::to_string(i));
  };
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < kEach; ++i) {
        const auto epoch = static_cast<uint64_t>(thread * kEach + i + 1);
        EXPECT_TRUE(journal_->SaveStart(MakeAttempt(epoch, task(thread, i))).ok());
        EXPECT_TRUE(journal_->SaveResult(epoch, task(thread, i), {.report_json = "{}"}).ok());
      }
    });
  }
  threads.clear();
  Reopen();
  EXPECT_TRUE(journal_->LoadOpenAttempts()->empty());
  for (int thread = 0; thread < kThreads; ++thread) {
    for (int i = 0; i < kEach; ++i) {
      EXPECT_TRUE(journal_->LoadResults({task(thread, i)})->at(0).has_value());
    }
  }
}

TEST_P(JournalContract, ALaterOneIsRefusedOrPutsTheEarlierOutOfOffice) {
  const auto second = store_->Open();
  if (second.ok()) {  // a file, which StateLock guards
    EXPECT_TRUE(absl::IsFailedPrecondition(journal_->SaveStart(MakeAttempt(1))));
    EXPECT_TRUE(absl::IsFailedPrecondition(journal_->Confirm()));
    EXPECT_TRUE((*second)->SaveStart(MakeAttempt(1)).ok());
    EXPECT_TRUE((*second)->Confirm().ok());
  } else {
    EXPECT_TRUE(absl::IsFailedPrecondition(second.status())) << second.status();
    EXPECT_THAT(std::string(second.status().message()), HasSubstr("another coordinator"));
    EXPECT_TRUE(journal_->SaveStart(MakeAttempt(1)).ok());
  }
}

INSTANTIATE_TEST_SUITE_P(Sqlite, JournalContract, ::testing::Values([]() -> std::unique_ptr<Store> {
                           return std::make_unique<SqliteStore>();
                         }));

INSTANTIATE_TEST_SUITE_P(Postgres,
                         JournalContract,
                         ::testing::Values([]() -> std::unique_ptr<Store> {
                           if (Server() == nullptr) return nullptr;
                           return std::make_unique<PostgresStore>();
                         }));

TEST(PostgresJournal, GoesOnWhenItsServerWasStartedAgain) {
  if (Server() == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
  const auto journal = OpenPostgresJournal(Server()->MakeDatabase("restarted"));
  ASSERT_TRUE(journal.ok()) << journal.status();
  ASSERT_TRUE((*journal)->SaveResult(1, kTask, {.report_json = "first"}).ok());
  Server()->Stop();
  EXPECT_TRUE(absl::IsUnavailable((*journal)->SaveResult(2, kTask, {})));
  EXPECT_TRUE(absl::IsUnavailable((*journal)->LoadResults({kTask}).status()));
  EXPECT_TRUE(absl::IsUnavailable((*journal)->Confirm()));
  ASSERT_TRUE(Server()->Resume());
  EXPECT_TRUE((*journal)->Confirm().ok());
  const auto found = (*journal)->LoadResults({kTask});
  ASSERT_TRUE(found.ok()) << found.status();
  EXPECT_EQ(found->at(0)->report_json, "first");
  EXPECT_TRUE((*journal)->SaveResult(2, kTask, {.report_json = "second"}).ok());
  EXPECT_EQ((*journal)->LoadResults({kTask})->at(0)->report_json, "second");
}

TEST(PostgresJournal, WhoLostTheServerAndWasSucceededWritesNoMore) {
  if (Server() == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
  const std::string url = Server()->MakeDatabase("succeeded");
  const auto deposed = OpenPostgresJournal(url);
  ASSERT_TRUE(deposed.ok()) << deposed.status();
  Server()->Stop();
  ASSERT_TRUE(Server()->Resume());
  {
    const auto successor = OpenPostgresJournal(url);
    ASSERT_TRUE(successor.ok()) << successor.status();
    EXPECT_TRUE(absl::IsFailedPrecondition((*deposed)->SaveResult(1, kTask, {})));
    EXPECT_TRUE(absl::IsFailedPrecondition((*deposed)->Confirm()));
    EXPECT_TRUE((*successor)->SaveResult(2, kTask, {}).ok());
  }
  EXPECT_TRUE(absl::IsFailedPrecondition((*deposed)->SaveResult(1, kTask, {})))
      << "the lock is free, but the generation is another's";
}

TEST(PostgresJournal, WhoIsTakenOverInTheMiddleOfItsCommitsLosesNoneThatItWasTold) {
  if (Server() == nullptr) GTEST_SKIP() << "PostgreSQL's server is not installed";
  const std::string url = Server()->MakeDatabase("taken_over");
  uint64_t told = 0;  // results of which somebody was told that they are saved
  for (int turn = 0; turn < 5; ++turn) {
    auto deposed = OpenPostgresJournal(url);
    ASSERT_TRUE(deposed.ok()) << deposed.status();
    std::atomic<uint64_t> saved{told};
    std::jthread saving([&] {
      while (true) {
        const Digest task = DigestOf("task" + std::to_string(saved.load()));
        if (!(*deposed)->SaveResult(saved + 1, task, {.report_json = "r"}).ok()) return;
        ++saved;
      }
    });
    ASSERT_TRUE(testing::WaitUntil([&] { return saved >= told + 20; }, 60.0));
    Server()->CutOff("taken_over");  // whatever it is doing
    saving.join();
    Server()->LetIn("taken_over");
    const auto successor = OpenPostgresJournal(url);
    ASSERT_TRUE(successor.ok()) << successor.status();
    EXPECT_TRUE(absl::IsFailedPrecondition((*deposed)->SaveResult(1, DigestOf("late"), {})));
    told = saved;
    std::vector<Digest> tasks;
    for (uint64_t i = 0; i < told; ++i) tasks.push_back(DigestOf("task" + std::to_string(i)));
    const auto results = (*successor)->LoadResults(tasks);
    ASSERT_TRUE(results.ok()) << results.status();
    for (uint64_t i = 0; i < told; ++i) EXPECT_TRUE(results->at(i).has_value()) << i;
    EXPECT_FALSE((*successor)->LoadResults({DigestOf("late")})->at(0).has_value());
  }
}

TEST(PostgresJournal, RefusesAPasswordOnTheCommandLine) {
  for (const char* url : {"postgresql://me:geheim@host/db", "host=h password=geheim dbname=db"}) {
    const auto journal = OpenPostgresJournal(url);
    EXPECT_TRUE(absl::IsInvalidArgument(journal.status()));
    EXPECT_THAT(std::string(journal.status().message()), HasSubstr("PGPASSFILE"));
    EXPECT_THAT(std::string(journal.status().message()), Not(HasSubstr("geheim")));
  }
}

TEST(PostgresJournal, SaysThatItCannotReachTheServer) {
  const TemporaryFolder folder;
  const auto journal = OpenPostgresJournal("host=" + folder.Path() + " dbname=db");
  EXPECT_TRUE(absl::IsUnavailable(journal.status()));
  EXPECT_THAT(std::string(journal.status().message()), HasSubstr("cannot reach"));
  EXPECT_TRUE(absl::IsInvalidArgument(OpenPostgresJournal("journal.db").status()));
}

}  // namespace
}  // namespace orbweave
