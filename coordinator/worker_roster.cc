// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/worker_roster.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr double kForEver_s = std::numeric_limits<double>::infinity();
/// How long, and how many, workers are remembered that are gone.
constexpr double kRemembered_s = 86'400.0;
constexpr size_t kMostGone = 1000;

}  // namespace

void WorkerRoster::Remember(const WorkerBlame& blame, double now_s) {
  Record& record = records_[blame.worker];
  record.heard_s = now_s;
  record.process = blame.process;
  record.blames = blame.blames;
}

std::vector<WorkerBlame> WorkerRoster::TakeBlames() {
  std::vector<WorkerBlame> blames;
  for (const std::string& name : std::exchange(changed_, {})) {
    const auto it = records_.find(name);
    blames.push_back(it == records_.end()
                         ? WorkerBlame{.worker = name}
                         : WorkerBlame{name, it->second.process, it->second.Faults()});
  }
  return blames;
}

void WorkerRoster::SetBlames(const std::string& name, uint32_t blames) {
  if (std::exchange(records_.at(name).blames, blames) != blames) changed_.insert(name);
}

void WorkerRoster::ForgetGone(double now_s) {
  constexpr double kBetweenLooks_s = 60.0;
  constexpr size_t kMoreBetweenLooks = kMostGone / 4;
  if (now_s < next_look_s_ && records_.size() < next_look_size_) return;
  std::vector<std::tuple<bool, double, std::string>> gone;  // the last ones first
  for (const auto& [name, record] : records_) {
    if (!IsAlive(record, now_s)) gone.emplace_back(!IsSetAside(record), -record.heard_s, name);
  }
  std::ranges::sort(gone);
  for (size_t i = 0; i < gone.size(); ++i) {
    const auto& [is_harmless, heard_s, name] = gone[i];
    if (i >= kMostGone || now_s + heard_s > kRemembered_s) Forget(name);
  }
  next_look_s_ = now_s + kBetweenLooks_s;
  next_look_size_ = records_.size() + kMoreBetweenLooks;
}

void WorkerRoster::Forget(const std::string& name) {
  const auto it = records_.find(name);
  names_.erase(it->second.session);
  if (it->second.Faults() > 0) changed_.insert(name);
  records_.erase(it);
}

void WorkerRoster::Join(const WorkerInfo& worker, uint64_t session, double now_s) {
  Record& record = records_[worker.name];
  names_.erase(record.session);
  record.session = session;
  record.heard_s = now_s;
  record.slots = worker.slots;
  record.offers = worker.offers;
  record.leaves_s = now_s + worker.stays_s.value_or(kForEver_s);
  record.draining = false;
  const bool is_another = worker.process == 0 || worker.process != record.process;
  record.process = worker.process;
  if (is_another && std::exchange(record.damages, 0) > 0) changed_.insert(worker.name);
  if (is_another) SetBlames(worker.name, 0);
  names_[session] = worker.name;
}

absl::Status WorkerRoster::Check(uint64_t session) const {
  if (names_.contains(session)) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat("session ", session, " is over: join again"));
}

absl::Status WorkerRoster::CheckSlot(uint64_t session, uint32_t slot) const {
  ORBWEAVE_RETURN_IF_ERROR(Check(session));
  const uint32_t slots = records_.at(names_.at(session)).slots;
  if (slot < slots) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("a worker of ", slots, " slots has no slot ", slot));
}

absl::Status WorkerRoster::Hear(uint64_t session, double now_s) {
  ORBWEAVE_RETURN_IF_ERROR(Check(session));
  records_.at(names_.at(session)).heard_s = now_s;
  return absl::OkStatus();
}

void WorkerRoster::End(uint64_t session) {
  const auto it = names_.find(session);
  if (it == names_.end()) return;
  records_.at(it->second).session = 0;
  names_.erase(it);
}

std::vector<std::string> WorkerRoster::PresentFrom(std::string_view prefix) const {
  std::vector<std::string> names;
  for (auto it = records_.lower_bound(prefix);
       it != records_.end() && it->first.starts_with(prefix);
       ++it) {
    if (it->second.session != 0) names.push_back(it->first);
  }
  return names;
}

absl::StatusOr<std::vector<std::string>> WorkerRoster::Drain(std::string_view name) {
  const bool means_all = name.ends_with('*');
  const std::string prefix(means_all ? name.substr(0, name.size() - 1) : name);
  std::vector<std::string> meant = PresentFrom(prefix);
  if (meant.empty() || name.empty())
    return absl::NotFoundError(absl::StrCat("there is no worker ", prefix));
  const bool is_whole = meant.front() == prefix;
  if (!means_all && !is_whole && meant.size() > 1) {
    return absl::InvalidArgumentError(absl::StrCat(meant.size(),
                                                   " workers' names begin with ",
                                                   prefix,
                                                   ", ",
                                                   meant[0],
                                                   " and ",
                                                   meant[1],
                                                   " among them: give more of one, or ",
                                                   prefix,
                                                   "* for all"));
  }
  if (!means_all) meant.resize(1);
  for (const std::string& worker : meant) records_.at(worker).draining = true;
  return meant;
}

bool WorkerRoster::IsDraining(uint64_t session) const {
  const auto it = names_.find(session);
  return it != names_.end() && records_.at(it->second).draining;
}

void WorkerRoster::CountTask(uint64_t session, const std::set<std::string>& failed_on) {
  const std::string name = NameOf(session);
  for (const std::string& other : failed_on) {
    const auto it = records_.find(other);
    if (other != name && it != records_.end()) SetBlames(other, it->second.blames + 1);
  }
  if (name.empty()) return;
  ++records_.at(name).tasks_done;
  SetBlames(name, 0);
}

void WorkerRoster::CountDamage(const std::string& name) {
  const auto it = records_.find(name);
  if (it == records_.end()) return;
  ++it->second.damages;
  changed_.insert(name);
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
  return record.Faults() >= kMaxBlames;
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

double WorkerRoster::StaysFor(std::string_view name, double now_s) const {
  const auto it = records_.find(name);
  return it == records_.end() ? kForEver_s : it->second.leaves_s - now_s;
}

double WorkerRoster::LongestStay(double now_s) const {
  const std::vector<std::string> serving = Serving(now_s);
  if (serving.empty()) return kForEver_s;
  double longest_s = 0.0;
  for (const std::string& name : serving) longest_s = std::max(longest_s, StaysFor(name, now_s));
  return longest_s;
}

uint32_t WorkerRoster::SlotsAtWork(double now_s) const {
  uint32_t slots = 0;
  for (const std::string& name : Serving(now_s)) slots += records_.at(name).slots;
  return slots;
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
