// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "coordinator/journal/forwarding_journal.h"
#include "coordinator/journal/open_journal.h"
#include "tests/support/command.h"

namespace orbweave::testing {

/// A journal whose disk fills up and whose server goes away, when told to.
class FailingJournal final : public ForwardingJournal {
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
      : ForwardingJournal(std::move(journal)), fails_(fails) {}

  absl::Status Confirm() override {
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal().Confirm();
  }
  absl::Status TrySave() override {
    if (fails_.probes_fail) return absl::ResourceExhaustedError("disk full");
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal().TrySave();
  }
  absl::Status SaveStarts(const std::vector<Attempt>& attempts) override {
    if (fails_.starts_fail) return absl::ResourceExhaustedError("disk full");
    fails_.is_starting = true;
    WaitUntil([this] { return !fails_.starts_are_slow; }, 20.0);
    return journal().SaveStarts(attempts);
  }
  absl::Status SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) override {
    if (fails_.results_fail) return absl::UnavailableError("away");
    if (fails_.is_lost) return absl::FailedPreconditionError("another coordinator has it");
    return journal().SaveResult(epoch, task, result);
  }
  absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) override {
    if (fails_.lookups_fail) return absl::UnavailableError("away");
    auto found = journal().LoadResults(tasks);
    const bool is_held = std::find(tasks.begin(), tasks.end(), fails_.held_lookup) != tasks.end();
    if (is_held || fails_.lookups_hang) {
      fails_.is_holding = true;
      WaitUntil([this] { return fails_.may_answer.load(); }, 20.0);
    }
    return found;
  }

 private:
  Switch& fails_;
};

/// For CoordinatorOptions: OpenJournal's, which fails as `fails` says.
inline auto OpenFailingJournal(FailingJournal::Switch& fails) {
  return [&fails](const std::string& state_dir) -> absl::StatusOr<std::unique_ptr<Journal>> {
    ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> journal, OpenJournal(state_dir));
    return std::make_unique<FailingJournal>(std::move(journal), fails);
  };
}

}  // namespace orbweave::testing
