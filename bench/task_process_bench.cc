// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What it costs a task to run in a process of its own: a task that reads a blob the worker has, and
// one that leaves a blob behind.

#include <benchmark/benchmark.h>

#include <map>

#include "worker/serve_tasks.h"
#include "worker/task_process.h"

namespace orbweave {
namespace {

/// A store that is always ready and costs nothing.
class OneBlob final : public BlobAccess {
 public:
  explicit OneBlob(std::string bytes) : bytes_(std::move(bytes)) {}
  absl::StatusOr<std::string> Get(const Digest&) override { return bytes_; }
  absl::StatusOr<Digest> Put(std::string_view) override { return Digest(); }
  absl::Status Write(const Digest&, uint64_t, const NextPiece&) override { return {}; }

 private:
  std::string bytes_;
};

absl::StatusOr<TaskResult> Read(const TaskSpec& spec, BlobAccess& blobs, const StageContext&) {
  ORBWEAVE_RETURN_IF_ERROR(blobs.Get(spec.inputs.at(0)).status());
  return TaskResult{.report_json = "{}"};
}

absl::StatusOr<TaskResult> Write(const TaskSpec& spec, BlobAccess& blobs, const StageContext&) {
  const std::string bytes(std::stoul(spec.options_text), 'x');
  ORBWEAVE_RETURN_IF_ERROR(blobs.Put(bytes).status());
  return TaskResult{.report_json = "{}"};
}

const StageFunction* FindBenchStage(std::string_view stage) {
  static const auto* const kStages =
      new std::map<std::string, StageFunction, std::less<>>{{"read", Read}, {"write", Write}};
  const auto found = kStages->find(stage);
  return found == kStages->end() ? nullptr : &found->second;
}

void RunStage(benchmark::State& state, const char* stage) {
  const auto size = static_cast<size_t>(state.range(0));
  OneBlob blobs(std::string(size, 'x'));
  BlobCache cache(blobs, size_t{64} << 20, {});
  const SteadyClock clock;
  TaskProcess process({}, clock);
  const TaskSpec spec{
      .stage = stage, .inputs = {DigestOf("blob")}, .options_text = std::to_string(size)};
  for (auto _ : state) {
    TaskBlobs task_blobs(cache);
    const bool ran = process.Run(spec, task_blobs, {}).ok();
    if (!ran || !task_blobs.Settle().ok()) state.SkipWithError("the task failed");
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) * state.range(0));
}

void BM_Read(benchmark::State& state) { RunStage(state, "read"); }
void BM_Write(benchmark::State& state) { RunStage(state, "write"); }

BENCHMARK(BM_Read)->RangeMultiplier(8)->Range(1 << 10, 32 << 20)->UseRealTime();
BENCHMARK(BM_Write)->RangeMultiplier(8)->Range(1 << 10, 32 << 20)->UseRealTime();

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "exec-tasks") {
    const orbweave::StageLookup stages = orbweave::FindBenchStage;
    orbweave::ServeTasks(
        orbweave::FileDescriptor(orbweave::kChannelDescriptor), stages, orbweave::SteadyClock());
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
