// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/worker_roster.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {

void WorkerRoster::Remember(const WorkerBlame& blame) {
  Record& record = records_[blame.worker];
  record.process = blame.process;
  record.blames = blame.blames;
}

std::vector<WorkerBlame> WorkerRoster::TakeBlames() {
  std::vector<WorkerBlame> blames;
  for (const std::string& name : std::exchange(changed_, {})) {
    const Record& record = records_[name];
    blames.push_back({name, record.process, record.blames});
  }
  return blames;
}

void WorkerRoster::SetBlames(const std::string& name, uint32_t blames) {
  if (std::exchange(records_[name].blames, blames) != blames) changed_.insert(name);
}

void WorkerRoster::Join(const WorkerInfo& worker, uint64_t session, double now_s) {
  Record& record = records_[worker.name];
  names_.erase(record.session);
  record.session = session;
  record.heard_s = now_s;
  record.slots = worker.slots;
  record.offers = worker.offers;
  record.draining = false;
  const bool is_another = worker.process == 0 || worker.process != record.process;
  record.process = worker.process;
  if (is_another) SetBlames(worker.name, 0);
  names_[session] = worker.name;
}

absl::Status WorkerRoster::Check(uint64_t session) const {
  if (names_.contains(session)) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat("session ", session, " is over: join again"));
}

absl::Status WorkerRoster::Hear(uint64_t session, double now_s) {
  ORBWEAVE_RETURN_IF_ERROR(Check(session));
  records_[names_.at(session)].heard_s = now_s;
  return absl::OkStatus();
}

void WorkerRoster::End(uint64_t session) {
  const auto it = names_.find(session);
  if (it == names_.end()) return;
  records_[it->second].session = 0;
  names_.erase(it);
}

absl::Status WorkerRoster::Drain(std::string_view name) {
  const auto it = records_.find(name);
  if (it == records_.end() || it->second.session == 0)
    return absl::NotFoundError(absl::StrCat("there is no worker ", std::string(name)));
  it->second.draining = true;
  return absl::OkStatus();
}

bool WorkerRoster::IsDraining(uint64_t session) const {
  const auto it = names_.find(session);
  return it != names_.end() && records_.at(it->second).draining;
}

void WorkerRoster::CountTask(uint64_t session, const std::set<std::string>& failed_on) {
  const std::string name = NameOf(session);
  for (const std::string& other : failed_on) {
    if (other != name) SetBlames(other, records_[other].blames + 1);
  }
  if (name.empty()) return;
  ++records_[name].tasks_done;
  SetBlames(name, 0);
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

bool WorkerRoster::IsSetAside(const Record& record) {
  constexpr uint32_t kMaxBlames = 3;
  return record.blames >= kMaxBlames;
}

std::vector<std::string> WorkerRoster::Serving(double now_s) const {
  std::vector<std::string> serving;
  std::vector<std::string> set_aside;
  for (const auto& [name, record] : records_) {
    if (!IsAlive(record, now_s) || record.draining) continue;
    (IsSetAside(record) ? set_aside : serving).push_back(name);
  }
  return serving.empty() ? set_aside : serving;
}

uint32_t WorkerRoster::Slots(double now_s) const {
  uint32_t slots = 0;
  for (const auto& [name, record] : records_) {
    if (IsAlive(record, now_s)) slots += record.slots;
  }
  return slots;
}

std::vector<std::string> WorkerRoster::Able(const std::vector<std::string>& workers,
                                            const StageNeeds& needs) const {
  std::vector<std::string> able;
  std::ranges::copy_if(workers, std::back_inserter(able), [&](const std::string& name) {
    const Record& record = records_.at(name);
    return TasksAtOnce(record.offers, record.slots, needs) > 0;
  });
  return able;
}

bool WorkerRoster::HasRoom(std::string_view name,
                           const StageNeeds& taken,
                           const StageNeeds& needs) const {
  const auto it = records_.find(name);
  return it != records_.end() &&
         orbweave::HasRoom(it->second.offers, it->second.slots, taken, needs);
}

std::string WorkerRoster::Missing(const StageNeeds& needs, double now_s) const {
  std::vector<WorkerOffers> offers;
  for (const std::string& name : Serving(now_s)) {
    const Record& record = records_.at(name);
    if (TasksAtOnce(record.offers, record.slots, needs) > 0) return {};
    offers.push_back(WithThreads(record.offers, record.slots));
  }
  return offers.empty() ? "" : DescribeMissing(offers, needs);
}

std::vector<WorkerStatus> WorkerRoster::Status(double now_s) const {
  std::vector<WorkerStatus> workers;
  for (const auto& [name, record] : records_) {
    workers.push_back({.name = name,
                       .slots = record.slots,
                       .tasks_done = record.tasks_done,
                       .alive = IsAlive(record, now_s),
                       .set_aside = IsSetAside(record),
                       .draining = record.draining});
  }
  return workers;
}

}  // namespace orbweave
