// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_meter.h"

#include <chrono>
#include <utility>

#include "coordinator/journal/forwarding_journal.h"

namespace orbweave {
namespace {

class JournalMeter final : public ForwardingJournal {
 public:
  JournalMeter(std::unique_ptr<Journal> journal, SaveObserver observer)
      : ForwardingJournal(std::move(journal)), observer_(std::move(observer)) {}

  absl::Status TrySave() override {
    return Time("probe", [&] { return journal().TrySave(); });
  }
  absl::Status SaveJob(const JobEntry& job) override {
    return Time("job", [&] { return journal().SaveJob(job); });
  }
  absl::Status SaveStarts(const std::vector<Attempt>& attempts) override {
    return Time("start", [&] { return journal().SaveStarts(attempts); });
  }
  absl::Status SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) override {
    return Time("result", [&] { return journal().SaveResult(epoch, task, result); });
  }
  absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) override {
    return Time("ends", [&] { return journal().SaveEnds(ends); });
  }
  absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) override {
    return Time("blames", [&] { return journal().SaveBlames(blames); });
  }
  absl::Status ForgetJob(const Digest& job) override {
    return Time("forget", [&] { return journal().ForgetJob(job); });
  }
  absl::Status ForgetResultOf(const Digest& task) override {
    return Time("forget", [&] { return journal().ForgetResultOf(task); });
  }

 private:
  template <typename Save>
  absl::Status Time(std::string_view what, Save&& save) {
    const auto start = std::chrono::steady_clock::now();
    const absl::Status status = save();
    const std::chrono::duration<double> wait = std::chrono::steady_clock::now() - start;
    observer_(what, wait.count(), status);
    return status;
  }

  SaveObserver observer_;
};

}  // namespace

std::unique_ptr<Journal> MeterJournal(std::unique_ptr<Journal> journal, SaveObserver observer) {
  return std::make_unique<JournalMeter>(std::move(journal), std::move(observer));
}

}  // namespace orbweave
