// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "coordinator/journal/journal.h"

namespace orbweave {

/// Another journal, for those who add to some of its calls.
class ForwardingJournal : public Journal {
 public:
  explicit ForwardingJournal(std::unique_ptr<Journal> journal) : journal_(std::move(journal)) {}

  uint64_t generation() const override { return journal_->generation(); }
  absl::Status Confirm() override { return journal_->Confirm(); }
  absl::Status TrySave() override { return journal_->TrySave(); }
  absl::Status SaveJob(const JobEntry& job) override { return journal_->SaveJob(job); }
  absl::StatusOr<std::vector<JobEntry>> LoadJobs() override { return journal_->LoadJobs(); }
  absl::Status ForgetJob(const Digest& job) override { return journal_->ForgetJob(job); }
  absl::Status SaveStarts(const std::vector<Attempt>& attempts) override {
    return journal_->SaveStarts(attempts);
  }
  absl::Status SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) override {
    return journal_->SaveResult(epoch, task, result);
  }
  absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) override {
    return journal_->SaveEnds(ends);
  }
  absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) override {
    return journal_->LoadResults(tasks);
  }
  absl::Status ForgetResultOf(const Digest& task) override {
    return journal_->ForgetResultOf(task);
  }
  absl::StatusOr<uint64_t> ForgetResults(const IsGarbage& is_garbage) override {
    return journal_->ForgetResults(is_garbage);
  }
  absl::StatusOr<std::vector<Attempt>> LoadOpenAttempts() override {
    return journal_->LoadOpenAttempts();
  }
  absl::StatusOr<std::vector<FailedAttempt>> LoadFailures(const Digest& job,
                                                          uint64_t since_epoch) override {
    return journal_->LoadFailures(job, since_epoch);
  }
  absl::StatusOr<std::vector<AttemptRecord>> LoadAttempts(const Digest& task) override {
    return journal_->LoadAttempts(task);
  }
  absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) override {
    return journal_->SaveBlames(blames);
  }
  absl::StatusOr<std::vector<WorkerBlame>> LoadBlames() override { return journal_->LoadBlames(); }

 protected:
  [[nodiscard]] Journal& journal() { return *journal_; }

 private:
  std::unique_ptr<Journal> journal_;
};

}  // namespace orbweave
