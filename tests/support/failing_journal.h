// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "coordinator/journal.h"
#include "tests/support/command.h"

namespace orbweave::testing {

/// A journal whose disk fills up and whose server goes away, when told to.
class FailingJournal final : public Journal {
 public:
  struct Switch {
    std::atomic<bool> starts_fail{false};
    std::atomic<bool> results_fail{false};
    std::atomic<bool> lookups_fail{false};
    std::atomic<bool> lookups_hang{false};  ///< until it may answer
    std::atomic<bool> probes_fail{false};
    std::atomic<bool> is_lost{false};  ///< another coordinator has it
    Digest held_lookup{};  ///< who asks for this task is answered late, with what was known before
    std::atomic<bool> is_holding{false};
    std::atomic<bool> may_answer{false};
    std::atomic<bool> starts_are_slow{false};  ///< until that ends
    std::atomic<bool> is_starting{false};
  };

  FailingJournal(std::unique_ptr<Journal> journal, Switch& fails)
      : journal_(std::move(journal)), fails_(fails) {}

  uint64_t generation() const override { return journal_->generation(); }
  absl::Status Confirm() override {
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal_->Confirm();
  }
  absl::Status TrySave() override {
    if (fails_.probes_fail) return absl::ResourceExhaustedError("disk full");
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal_->TrySave();
  }
  absl::Status SaveJob(const JobEntry& job) override { return journal_->SaveJob(job); }
  absl::StatusOr<std::vector<JobEntry>> LoadJobs() override { return journal_->LoadJobs(); }
  absl::Status ForgetJob(const Digest& job) override { return journal_->ForgetJob(job); }
  absl::Status ForgetResultOf(const Digest& task) override {
    return journal_->ForgetResultOf(task);
  }
  absl::StatusOr<uint64_t> ForgetResults(const IsGarbage& is_garbage) override {
    return journal_->ForgetResults(is_garbage);
  }
  absl::Status SaveStarts(const std::vector<Attempt>& attempts) override {
    if (fails_.starts_fail) return absl::ResourceExhaustedError("disk full");
    fails_.is_starting = true;
    WaitUntil([this] { return !fails_.starts_are_slow; }, 20.0);
    return journal_->SaveStarts(attempts);
  }
  absl::Status SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) override {
    if (fails_.results_fail) return absl::UnavailableError("away");
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal_->SaveResult(epoch, task, result);
  }
  absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) override {
    return journal_->SaveEnds(ends);
  }
  absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) override {
    if (fails_.lookups_fail) return absl::UnavailableError("away");
    auto found = journal_->LoadResults(tasks);
    const bool is_held = std::find(tasks.begin(), tasks.end(), fails_.held_lookup) != tasks.end();
    if (is_held || fails_.lookups_hang) {
      fails_.is_holding = true;
      WaitUntil([this] { return fails_.may_answer.load(); }, 20.0);
    }
    return found;
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
  absl::StatusOr<std::vector<WorkerBlame>> LoadBlames() override { return journal_->LoadBlames(); }
  absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) override {
    return journal_->SaveBlames(blames);
  }

 private:
  std::unique_ptr<Journal> journal_;
  Switch& fails_;
};

}  // namespace orbweave::testing
