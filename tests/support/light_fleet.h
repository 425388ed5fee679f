// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/sleep.h"
#include "tests/support/wide_job.h"
#include "worker/grpc_coordinator_client.h"
#include "worker/task_executor.h"
#include "worker/worker_loop.h"

/// Many workers whose tasks cost nothing, in threads of one process: what is left is the
/// coordinator and the way to it, with real sessions, heartbeats, leases and blobs.

namespace orbweave::testing {

inline std::string LightAnswer(const Digest& recipe) { return "the answer to " + recipe.ToHex(); }

/// How often each part of wide jobs was run. Thread-safe.
class RunCounter {
 public:
  void Count(const Digest& recipe) {
    const std::lock_guard lock(mutex_);
    ++runs_[recipe];
  }
  [[nodiscard]] uint32_t RunsOf(const Digest& recipe) {
    const std::lock_guard lock(mutex_);
    return runs_[recipe];
  }

 private:
  std::mutex mutex_;
  std::map<Digest, uint32_t> runs_;
};

/// Waits for a while, and leaves a short blob.
class LightExecutor final : public TaskExecutor {
 public:
  LightExecutor(RunCounter& runs, double task_s) : runs_(runs), task_s_(task_s) {}

  absl::StatusOr<TaskResult> Run(const TaskSpec& spec,
                                 TaskBlobs& blobs,
                                 const StageContext& context) override {
    runs_.Count(spec.inputs.at(0));
    SleepUnlessStopped(task_s_, context.stop);
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    TaskResult result{.report_json = "{}"};
    const std::string answer = LightAnswer(spec.inputs.at(0));
    blobs.Put(result.outputs.emplace_back(DigestOf(answer)), SharedBytes::Of(answer));
    return result;
  }

 private:
  RunCounter& runs_;
  double task_s_;
};

class LightFleet {
 public:
  /// Workers for the coordinator that listens on the unix socket `socket`. Each comes by a name of
  /// its own, a link in `folder`, and so over a connection of its own.
  LightFleet(const std::string& socket, const std::string& folder, uint32_t workers, double task_s)
      : LightFleet(socket, folder, workers, [this, task_s] {
          return std::make_unique<LightExecutor>(runs_, task_s);
        }) {}
  /// The same with other executors.
  LightFleet(const std::string& socket,
             const std::string& folder,
             uint32_t workers,
             MakeTaskExecutor make_executor)
      : make_executor_(std::move(make_executor)) {
    for (uint32_t i = 0; i < workers; ++i) {
      const std::string name = "w" + std::to_string(i);
      const std::string link = folder + "/" + name;
      std::filesystem::create_symlink(socket, link);
      threads_.emplace_back([this, name, link](const std::stop_token& stop) {
        GrpcCoordinatorClient coordinator("unix:" + link);
        const WorkerOptions options{.name = name, .grace_s = 0.0};
        if (!RunWorker(coordinator, coordinator, make_executor_, options, stop).ok()) ++refused_;
      });
    }
  }

  ~LightFleet() {
    for (std::jthread& thread : threads_) thread.request_stop();  // all at once
  }

  [[nodiscard]] RunCounter& runs() { return runs_; }
  /// Workers that the coordinator did not take.
  [[nodiscard]] uint32_t refused() const { return refused_; }

 private:
  RunCounter runs_;
  std::atomic<uint32_t> refused_{0};
  MakeTaskExecutor make_executor_;
  std::vector<std::jthread> threads_;  ///< last: end before what they use
};

/// What went wrong with a wide job that has ended.
struct LightFaults {
  uint64_t lost = 0;     ///< parts without their answer
  uint64_t doubled = 0;  ///< parts that were run more than once
};

inline absl::StatusOr<LightFaults> FaultsOf(JobApi& api,
                                            const Digest& job,
                                            const std::vector<Digest>& recipes,
                                            RunCounter& runs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes, api.GetOutcomes(job));
  std::map<uint32_t, Digest> answers;
  for (const TaskOutcome& outcome : outcomes) {
    if (outcome.result.outputs.size() == 1) answers[outcome.part] = outcome.result.outputs[0];
  }
  LightFaults faults;
  for (uint32_t part = 0; part < recipes.size(); ++part) {
    const bool is_right = answers[part] == DigestOf(LightAnswer(recipes[part]));
    faults.lost += is_right ? 0 : 1;
    faults.doubled += runs.RunsOf(recipes[part]) > 1 ? 1 : 0;
  }
  return faults;
}

}  // namespace orbweave::testing
