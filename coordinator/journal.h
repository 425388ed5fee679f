// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// A job as it is remembered across restarts.
struct JobEntry {
  JobSpec spec{};
  JobState state = JobState::kRunning;
  std::string error{};
  uint64_t number = 0;  ///< order of submission
};

/// What the coordinator must not forget, as small files: `results/<task>` per finished task,
/// `jobs/<job>` per job, `generation`. Each file carries the digest of its content and is replaced
/// whole. Thread-safe.
class Journal {
 public:
  [[nodiscard]] static absl::StatusOr<Journal> Open(const std::string& folder);

  /// 1, 2, 3, ...: how often this folder was opened. The high half of every epoch and session.
  [[nodiscard]] uint64_t generation() const { return generation_; }

  /// Durable when it returns OK.
  [[nodiscard]] absl::Status SaveResult(const Digest& task, const TaskResult& result);
  /// NotFound: never finished. DataLoss: the file is damaged.
  [[nodiscard]] absl::StatusOr<TaskResult> LoadResult(const Digest& task) const;

  [[nodiscard]] absl::Status SaveJob(const JobEntry& job);
  /// In order of submission; damaged files are left out.
  [[nodiscard]] absl::StatusOr<std::vector<JobEntry>> LoadJobs() const;

 private:
  explicit Journal(std::string folder) : folder_(std::move(folder)) {}
  [[nodiscard]] absl::Status BeginGeneration();
  [[nodiscard]] absl::Status Save(const std::string& name, const std::string& content) const;
  [[nodiscard]] absl::StatusOr<std::string> Load(const std::string& name) const;

  std::string folder_;
  uint64_t generation_ = 0;
};

}  // namespace orbweave
