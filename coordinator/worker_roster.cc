// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/worker_roster.h"

#include "absl/strings/str_cat.h"

namespace orbweave {

void WorkerRoster::Join(const WorkerInfo& worker, uint64_t session, double now_s) {
  Record& record = records_[worker.name];
  names_.erase(record.session);
  record.session = session;
  record.heard_s = now_s;
  record.slots = worker.slots;
  names_[session] = worker.name;
}

absl::Status WorkerRoster::Hear(uint64_t session, double now_s) {
  const auto it = names_.find(session);
  if (it == names_.end()) {
    return absl::NotFoundError(absl::StrCat("session ", session, " is over: join again"));
  }
  records_[it->second].heard_s = now_s;
  return absl::OkStatus();
}

void WorkerRoster::End(uint64_t session) {
  const auto it = names_.find(session);
  if (it == names_.end()) return;
  records_[it->second].session = 0;
  names_.erase(it);
}

void WorkerRoster::CountTask(uint64_t session) {
  const auto it = names_.find(session);
  if (it != names_.end()) ++records_[it->second].tasks_done;
}

std::string WorkerRoster::NameOf(uint64_t session) const {
  const auto it = names_.find(session);
  return it == names_.end() ? std::string() : it->second;
}

std::optional<uint64_t> WorkerRoster::SessionOf(std::string_view name) const {
  const auto it = records_.find(name);
  if (it == records_.end() || it->second.session == 0) return std::nullopt;
  return it->second.session;
}

bool WorkerRoster::IsAlive(const Record& record, double now_s) const {
  return record.session != 0 && now_s - record.heard_s <= silence_s_;
}

std::vector<std::string> WorkerRoster::Alive(double now_s) const {
  std::vector<std::string> names;
  for (const auto& [name, record] : records_) {
    if (IsAlive(record, now_s)) names.push_back(name);
  }
  return names;
}

std::vector<WorkerStatus> WorkerRoster::Status(double now_s) const {
  std::vector<WorkerStatus> workers;
  for (const auto& [name, record] : records_) {
    workers.push_back({.name = name,
                       .slots = record.slots,
                       .tasks_done = record.tasks_done,
                       .alive = IsAlive(record, now_s)});
  }
  return workers;
}

}  // namespace orbweave
