// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_table.h"

#include <algorithm>
#include <utility>

namespace orbweave {

bool JobDamage::IsIn(const TaskResult& result) const {
  const auto is_damaged = [this](const Digest& blob) { return blobs.contains(blob); };
  return std::ranges::any_of(result.outputs, is_damaged) ||
         std::ranges::any_of(result.recipes, is_damaged);
}

Job& JobTable::Begin(
    const JobSpec& spec, JobPlan plan, uint64_t number, const RetryPolicy& retry, double now_s) {
  const Digest id = spec.Id();
  order_[number] = id;
  Job& job = jobs_[id];
  job.number = number;
  job.run = ++last_run_;
  job.is_saved = false;
  job.had_ended = false;
  job.machine = std::make_unique<JobMachine>(spec, std::move(plan), retry, now_s);
  return job;
}

void JobTable::Forget(const Digest& id) {
  order_.erase(jobs_.at(id).number);
  jobs_.erase(id);
}

Job* JobTable::Find(const Digest& id) {
  const auto it = jobs_.find(id);
  return it == jobs_.end() ? nullptr : &it->second;
}

size_t JobTable::NumRunning() const {
  return static_cast<size_t>(
      std::ranges::count_if(jobs_, [](const auto& item) { return item.second.IsRunning(); }));
}

uint64_t JobTable::CountOpenTasks() const {
  uint64_t open = 0;
  for (const auto& [id, job] : jobs_) open += job.had_ended ? 0 : job.machine->CountOpenTasks();
  return open;
}

std::optional<Digest> JobTable::ToPlan() const {
  for (const auto& [number, id] : order_) {
    if (jobs_.at(id).machine->StageToPlan()) return id;
  }
  return std::nullopt;
}

std::optional<Digest> JobTable::ToSave() const {
  for (const auto& [number, id] : order_) {
    const Job& job = jobs_.at(id);
    if (!job.is_saved && !job.IsRunning()) return id;
  }
  return std::nullopt;
}

JobSnapshot JobTable::Snapshot(const Digest& id, uint32_t stage) const {
  const Job& job = jobs_.at(id);
  return {job.machine->spec(), job.machine->plan(), stage, job.machine->results(), job.verify};
}

bool JobTable::WasDoneBy(const Lease& lease) const {
  return std::any_of(jobs_.begin(), jobs_.end(), [&lease](const auto& item) {
    return item.second.machine->WasDoneBy(lease.task, lease.epoch);
  });
}

}  // namespace orbweave
