// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What durability costs: attempts written down and taken by several threads at once, and whole
// tasks given out and taken by a coordinator. Set ORBWEAVE_BENCH_JOURNAL to the address of an empty
// PostgreSQL database to measure it instead of a file; TMPDIR says on which disk the file is.

#include <benchmark/benchmark.h>

#include <atomic>
#include <cstdlib>
#include <memory>

#include "coordinator/coordinator.h"
#include "coordinator/journal/postgres_journal.h"
#include "coordinator/journal/sqlite_journal.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/wide_job.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;

absl::StatusOr<std::unique_ptr<Journal>> OpenBenchJournal(const std::string& folder) {
  const char* url = std::getenv("ORBWEAVE_BENCH_JOURNAL");
  if (url != nullptr) return OpenPostgresJournal(url);
  return OpenSqliteJournal(folder + "/journal.db");
}

/// One task per iteration: its lease is committed, then its result.
void CommitTasks(benchmark::State& state) {
  static std::unique_ptr<TemporaryFolder> folder;
  static std::unique_ptr<Journal> journal;
  static std::atomic<uint64_t> epoch;
  if (state.thread_index() == 0) {
    folder = std::make_unique<TemporaryFolder>();
    auto opened = OpenBenchJournal(folder->Path());
    ORBWEAVE_CHECK(opened.ok());
    journal = *std::move(opened);
    epoch = journal->generation() << 32;
  }
  const TaskResult result{.outputs = {DigestOf("o")}, .report_json = std::string(300, 'x')};
  for (auto _ : state) {
    const uint64_t mine = ++epoch;
    const Digest task = DigestOf(std::to_string(mine));
    const Attempt attempt{.epoch = mine, .task = task, .stage = "match_images", .worker = "w"};
    ORBWEAVE_CHECK(journal->SaveStart(attempt).ok());
    ORBWEAVE_CHECK(journal->SaveResult(mine, task, result).ok());
  }
  state.counters["commits"] = benchmark::Counter(2.0 * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
  if (state.thread_index() == 0) {
    journal.reset();
    folder.reset();
  }
}
BENCHMARK(CommitTasks)->ThreadRange(1, 64)->UseRealTime()->Unit(benchmark::kMillisecond);

/// One job of so many empty tasks per iteration, done by a worker that lives in the same process:
/// what is left is the coordinator.
void CoordinateTasks(benchmark::State& state) {
  const auto parts = static_cast<size_t>(state.range(0));
  const TemporaryFolder folder;
  const SteadyClock clock;
  CoordinatorOptions options{.state_dir = folder.Path(), .find_plan = testing::FindWidePlan};
  options.open_journal = OpenBenchJournal;
  const auto coordinator = Coordinator::Open(options, clock);
  ORBWEAVE_CHECK(coordinator.ok());
  Coordinator& api = **coordinator;
  const auto joined = api.Join({.name = "w", .version = std::string(BuildVersion())});
  uint64_t number = 0;
  for (auto _ : state) {
    const std::vector<Digest> recipes = testing::WideRecipes(number, parts);
    number += parts;
    ORBWEAVE_CHECK(api.SubmitJob(*testing::PrepareWideJob(api, recipes)).ok());
    for (size_t done = 0; done < parts; ++done) {
      const auto lease = api.LeaseTask(joined->session, 0, 60.0);
      ORBWEAVE_CHECK(lease.ok() && lease->has_value());
      ORBWEAVE_CHECK(api.CompleteTask(joined->session, **lease, {.report_json = "{}"}).ok());
    }
  }
  state.counters["s_per_task"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(parts),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(CoordinateTasks)->Arg(500)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbweave
