// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal_meter.h"

#include <chrono>
#include <utility>

namespace orbweave {
namespace {

class JournalMeter final : public Journal {
 public:
  JournalMeter(std::unique_ptr<Journal> journal, SaveObserver observer)
      : journal_(std::move(journal)), observer_(std::move(observer)) {}

  uint64_t generation() const override { return journal_->generation(); }

  absl::Status Confirm() override { return journal_->Confirm(); }
  absl::Status TrySave() override {
    return Time("probe", [&] { return journal_->TrySave(); });
  }

  absl::Status SaveJob(const JobEntry& job) override {
    return Time("job", [&] { return journal_->SaveJob(job); });
  }
  absl::Status SaveStarts(const std::vector<Attempt>& attempts) override {
    return Time("start", [&] { return journal_->SaveStarts(attempts); });
  }
  absl::Status SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) override {
    return Time("result", [&] { return journal_->SaveResult(epoch, task, result); });
  }
  absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) override {
    return Time("ends", [&] { return journal_->SaveEnds(ends); });
  }

  absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) override {
    return Time("blames", [&] { return journal_->SaveBlames(blames); });
  }
  absl::Status ForgetJob(const Digest& job) override {
    return Time("forget", [&] { return journal_->ForgetJob(job); });
  }
  absl::Status ForgetResultOf(const Digest& task) override {
    return Time("forget", [&] { return journal_->ForgetResultOf(task); });
  }
  absl::StatusOr<uint64_t> ForgetResults(const IsGarbage& is_garbage) override {
    return journal_->ForgetResults(is_garbage);
  }

  absl::StatusOr<std::vector<JobEntry>> LoadJobs() override { return journal_->LoadJobs(); }
  absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) override {
    return journal_->LoadResults(tasks);
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

 private:
  template <typename Save>
  absl::Status Time(std::string_view what, Save&& save) {
    const auto start = std::chrono::steady_clock::now();
    const absl::Status status = save();
    const std::chrono::duration<double> wait = std::chrono::steady_clock::now() - start;
    observer_(what, wait.count(), status);
    return status;
  }

  std::unique_ptr<Journal> journal_;
  SaveObserver observer_;
};

}  // namespace

std::unique_ptr<Journal> MeterJournal(std::unique_ptr<Journal> journal, SaveObserver observer) {
  return std::make_unique<JournalMeter>(std::move(journal), std::move(observer));
}

}  // namespace orbweave
