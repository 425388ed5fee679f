// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/base/clock.h"
#include "worker/task_executor.h"
#include "worker/task_runner.h"

namespace orbweave::testing {

/// Runs tasks on the calling thread, so that a test sees what its stages do. `stages` and `clock`
/// outlive it.
class InProcessExecutor final : public TaskExecutor {
 public:
  InProcessExecutor(const StageLookup& stages, const Clock& clock)
      : stages_(stages), clock_(clock) {}

  absl::StatusOr<TaskResult> Run(const TaskSpec& spec,
                                 TaskBlobs& blobs,
                                 const StageContext& context) override {
    OwnBlobs access(blobs);
    return RunTask(stages_, spec, access, context, clock_);
  }

 private:
  class OwnBlobs final : public BlobAccess {
   public:
    explicit OwnBlobs(TaskBlobs& blobs) : blobs_(blobs) {}
    absl::StatusOr<std::string> Get(const Digest& digest) override {
      ORBWEAVE_ASSIGN_OR_RETURN(const SharedBytes bytes, blobs_.Get(digest));
      return std::string(bytes.View());
    }
    absl::StatusOr<Digest> Put(std::string_view bytes) override {
      const Digest digest = DigestOf(bytes);
      blobs_.Put(digest, SharedBytes::CopyOf(bytes));
      return digest;
    }

   private:
    TaskBlobs& blobs_;
  };

  const StageLookup& stages_;
  const Clock& clock_;
};

inline MakeTaskExecutor RunInProcess(const StageLookup& stages, const Clock& clock) {
  return [&stages, &clock] { return std::make_unique<InProcessExecutor>(stages, clock); };
}

}  // namespace orbweave::testing
