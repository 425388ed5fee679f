// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/lease_book.h"

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

bool IsAtTheSlotOf(const LeaseEntry& x, const LeaseEntry& y) {
  return x.worker == y.worker && x.slot == y.slot;
}

}  // namespace

absl::Status StaleLease(uint64_t epoch, const Digest& task) {
  return absl::FailedPreconditionError(absl::StrCat(
      "stale lease of task ", task.ToShortHex(), " (epoch ", epoch, "): it was given away"));
}

void LeaseBook::Grant(LeaseEntry entry) {
  entry.waits = std::ranges::any_of(
      entries_, [&](const auto& item) { return IsAtTheSlotOf(entry, item.second); });
  entries_.emplace(entry.epoch, std::move(entry));
}

void LeaseBook::LetNextBegin(const LeaseEntry& gone) {
  const auto next = std::ranges::find_if(
      entries_, [&](const auto& item) { return IsAtTheSlotOf(gone, item.second); });
  if (next != entries_.end()) next->second.waits = false;
}

const LeaseEntry* LeaseBook::Renew(uint64_t epoch,
                                   const Digest& task,
                                   uint64_t session,
                                   double until_s) {
  const auto it = entries_.find(epoch);
  if (it == entries_.end() || it->second.task != task || it->second.session != session)
    return nullptr;
  it->second.until_s = until_s;
  return &it->second;
}

absl::StatusOr<LeaseEntry> LeaseBook::Take(uint64_t epoch, const Digest& task, uint64_t session) {
  const auto it = entries_.find(epoch);
  if (it == entries_.end() || it->second.task != task || it->second.session != session) {
    return StaleLease(epoch, task);
  }
  const LeaseEntry entry = it->second;
  entries_.erase(it);
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
  return taken;
}

template <typename Predicate>
std::vector<LeaseEntry> LeaseBook::TakeEndedIf(Predicate predicate) {
  std::vector<LeaseEntry> taken = TakeIf(predicate);
  for (const LeaseEntry& entry : taken) LetNextBegin(entry);
  return taken;
}

std::vector<LeaseEntry> LeaseBook::TakeExpired(double now_s) {
  return TakeIf([now_s](const LeaseEntry& entry) { return entry.until_s < now_s; });
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
  }
  return TakeIf(
      [&](const LeaseEntry& entry) { return entry.worker == worker && entry.session != session; });
}

size_t LeaseBook::CountAt(uint64_t session, uint32_t slot) const {
  return static_cast<size_t>(std::ranges::count_if(entries_, [&](const auto& item) {
    return item.second.session == session && item.second.slot == slot;
  }));
}

std::map<std::string, uint32_t> LeaseBook::BusySlots() const {
  std::set<std::pair<std::string_view, uint32_t>> busy;
  for (const auto& [epoch, entry] : entries_) busy.emplace(entry.worker, entry.slot);
  std::map<std::string, uint32_t> counts;
  for (const auto& [worker, slot] : busy) ++counts[std::string(worker)];
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
