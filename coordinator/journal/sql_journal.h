// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>

#include "coordinator/journal/group_commit.h"
#include "coordinator/journal/journal.h"
#include "coordinator/journal/sql_database.h"

namespace orbweave {

/// A journal in the tables of a database (journal_tables.h). Writers share transactions
/// (GroupCommit); readers have a connection of their own and do not wait for them.
class SqlJournal final : public Journal {
 public:
  /// Makes the tables that are missing and begins a generation. FailedPrecondition: the tables are
  /// of another format. Nobody else may have the journal: that is the caller's to see to.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<Journal>> Open(
      std::unique_ptr<SqlDatabase> writer, std::unique_ptr<SqlDatabase> reader);

  [[nodiscard]] uint64_t generation() const override { return generation_; }
  [[nodiscard]] absl::Status Confirm() override;
  [[nodiscard]] absl::Status TrySave() override;
  [[nodiscard]] absl::Status SaveJob(const JobEntry& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobEntry>> LoadJobs() override;
  [[nodiscard]] absl::Status ForgetJob(const Digest& job) override;
  [[nodiscard]] absl::Status SaveStarts(const std::vector<Attempt>& attempts) override;
  [[nodiscard]] absl::Status SaveResult(uint64_t epoch,
                                        const Digest& task,
                                        const TaskResult& result) override;
  [[nodiscard]] absl::Status SaveEnds(const std::vector<AttemptEnd>& ends) override;
  [[nodiscard]] absl::StatusOr<std::vector<std::optional<TaskResult>>> LoadResults(
      const std::vector<Digest>& tasks) override;
  [[nodiscard]] absl::Status ForgetResultOf(const Digest& task) override;
  [[nodiscard]] absl::StatusOr<uint64_t> ForgetResults(const IsGarbage& is_garbage) override;
  [[nodiscard]] absl::StatusOr<std::vector<Attempt>> LoadOpenAttempts() override;
  [[nodiscard]] absl::StatusOr<std::vector<FailedAttempt>> LoadFailures(
      const Digest& job, uint64_t since_epoch) override;
  [[nodiscard]] absl::StatusOr<std::vector<AttemptRecord>> LoadAttempts(
      const Digest& task) override;
  [[nodiscard]] absl::Status SaveBlames(const std::vector<WorkerBlame>& blames) override;
  [[nodiscard]] absl::StatusOr<std::vector<WorkerBlame>> LoadBlames() override;

 private:
  SqlJournal(std::unique_ptr<SqlDatabase> writer, std::unique_ptr<SqlDatabase> reader);
  /// All writes of a batch in one transaction, if this is still the journal's last generation.
  [[nodiscard]] absl::Status Transact(const std::vector<const GroupCommit::Write*>& writes);
  /// Makes `what` (a fault point) durable.
  [[nodiscard]] absl::Status Commit(std::string_view what, const GroupCommit::Write& write);
  /// Adds the tasks after `last`, a page of them, whose results are garbage to `candidates`, and
  /// moves `last` to its end; whether there are no more.
  [[nodiscard]] absl::StatusOr<bool> ReadPage(const IsGarbage& is_garbage,
                                              std::string& last,
                                              std::vector<std::string>& candidates);
  /// In a transaction; whether it was garbage.
  [[nodiscard]] absl::StatusOr<bool> ForgetResult(const std::string& task,
                                                  const IsGarbage& is_garbage);
  [[nodiscard]] absl::Status BeginAttempt(const Attempt& attempt, double now_s);
  [[nodiscard]] absl::Status EndAttempt(const AttemptEnd& end);

  std::unique_ptr<SqlDatabase> writer_;  ///< of whoever leads a commit
  std::mutex reading_mutex_;
  std::unique_ptr<SqlDatabase> reader_;
  GroupCommit commit_;
  uint64_t generation_ = 0;
};

}  // namespace orbweave
