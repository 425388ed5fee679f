// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/lease_book.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

WorkerSlot PlaceOf(const LeaseEntry& entry) { return {entry.worker, entry.slot}; }

}  // namespace

absl::Status StaleLease(uint64_t epoch, const Digest& task) {
  return absl::FailedPreconditionError(absl::StrCat(
      "stale lease of task ", task.ToShortHex(), " (epoch ", epoch, "): it was given away"));
}

void LeaseBook::Grant(LeaseEntry entry) {
  std::set<uint64_t>& at = epochs_at_[PlaceOf(entry)];
  entry.waits = !at.empty();
  at.insert(entry.epoch);
  earliest_end_s_ = std::min(earliest_end_s_, entry.until_s);
  entries_.emplace(entry.epoch, std::move(entry));
}

void LeaseBook::Forget(const LeaseEntry& gone) {
  const auto at = epochs_at_.find(PlaceOf(gone));
  at->second.erase(gone.epoch);
  if (at->second.empty()) epochs_at_.erase(at);
}

void LeaseBook::LetNextBegin(const LeaseEntry& gone) {
  const auto at = epochs_at_.find(PlaceOf(gone));
  if (at != epochs_at_.end()) entries_.at(*at->second.begin()).waits = false;
}

const LeaseEntry* LeaseBook::Renew(uint64_t epoch,
                                   const Digest& task,
                                   uint64_t session,
                                   double until_s) {
  const auto it = entries_.find(epoch);
  if (it == entries_.end() || it->second.task != task || it->second.session != session)
    return nullptr;
  it->second.until_s = until_s;
  earliest_end_s_ = std::min(earliest_end_s_, until_s);
  return &it->second;
}

absl::StatusOr<LeaseEntry> LeaseBook::Take(uint64_t epoch, const Digest& task, uint64_t session) {
  const auto it = entries_.find(epoch);
  if (it == entries_.end() || it->second.task != task || it->second.session != session) {
    return StaleLease(epoch, task);
  }
  const LeaseEntry entry = it->second;
  entries_.erase(it);
  Forget(entry);
  LetNextBegin(entry);
  return entry;
}

template <typename Predicate>
std::vector<LeaseEntry> LeaseBook::TakeIf(Predicate predicate) {
  std::vector<LeaseEntry> taken;
  std::erase_if(entries_, [&](const auto& item) {
    if (!predicate(item.second)) return false;
    taken.push_back(item.second);
    return true;
  });
  for (const LeaseEntry& entry : taken) Forget(entry);
  return taken;
}

template <typename Predicate>
std::vector<LeaseEntry> LeaseBook::TakeEndedIf(Predicate predicate) {
  std::vector<LeaseEntry> taken = TakeIf(predicate);
  for (const LeaseEntry& entry : taken) LetNextBegin(entry);
  return taken;
}

std::vector<LeaseEntry> LeaseBook::TakeExpired(double now_s) {
  if (earliest_end_s_ >= now_s) return {};
  std::vector<LeaseEntry> taken =
      TakeIf([now_s](const LeaseEntry& entry) { return entry.until_s < now_s; });
  earliest_end_s_ = kNoEnd;
  for (const auto& [epoch, entry] : entries_)
    earliest_end_s_ = std::min(earliest_end_s_, entry.until_s);
  return taken;
}

std::vector<LeaseEntry> LeaseBook::TakeSession(uint64_t session) {
  return TakeIf([session](const LeaseEntry& entry) { return entry.session == session; });
}

std::vector<LeaseEntry> LeaseBook::TakeJob(const Digest& job) {
  return TakeEndedIf([&job](const LeaseEntry& entry) { return entry.job == job; });
}

std::vector<LeaseEntry> LeaseBook::Adopt(std::string_view worker,
                                         const std::vector<LeaseProgress>& held,
                                         uint64_t session,
                                         double until_s) {
  for (const LeaseProgress& lease : held) {
    const auto it = entries_.find(lease.epoch);
    if (it == entries_.end() || it->second.task != lease.task || it->second.worker != worker)
      continue;
    it->second.session = session;
    it->second.until_s = until_s;
    earliest_end_s_ = std::min(earliest_end_s_, until_s);
  }
  return TakeIf(
      [&](const LeaseEntry& entry) { return entry.worker == worker && entry.session != session; });
}

size_t LeaseBook::CountAt(const WorkerSlot& place) const {
  const auto at = epochs_at_.find(place);
  return at == epochs_at_.end() ? 0 : at->second.size();
}

std::vector<const LeaseEntry*> LeaseBook::RunningBeside(const WorkerSlot& but) const {
  std::vector<const LeaseEntry*> running;
  for (auto at = epochs_at_.lower_bound({but.worker, 0});
       at != epochs_at_.end() && at->first.worker == but.worker;
       ++at) {
    if (at->first.slot != but.slot) running.push_back(&entries_.at(*at->second.begin()));
  }
  return running;
}

bool LeaseBook::Holds(const std::string& worker, const Digest& job) const {
  for (auto at = epochs_at_.lower_bound({worker, 0});
       at != epochs_at_.end() && at->first.worker == worker;
       ++at) {
    const auto is_of_job = [&](uint64_t epoch) { return entries_.at(epoch).job == job; };
    if (std::ranges::any_of(at->second, is_of_job)) return true;
  }
  return false;
}

std::map<std::string, uint32_t> LeaseBook::BusySlots() const {
  std::map<std::string, uint32_t> counts;
  for (const auto& [place, epochs] : epochs_at_) ++counts[place.worker];
  return counts;
}

std::vector<LeaseEntry*> LeaseBook::AwaitingPlace(const Digest& job) {
  std::vector<LeaseEntry*> entries;
  for (auto& [epoch, entry] : entries_) {
    if (!entry.ref && entry.job == job) entries.push_back(&entry);
  }
  return entries;
}

std::vector<LeaseEntry> LeaseBook::TakeTask(const Digest& job, TaskRef ref) {
  return TakeEndedIf([&](const LeaseEntry& entry) { return entry.job == job && entry.ref == ref; });
}

}  // namespace orbweave
