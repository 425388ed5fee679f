// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/held_leases.h"

namespace orbweave {

std::stop_token HeldLeases::Add(const Lease& lease) {
  const std::lock_guard lock(mutex_);
  Held& held = held_[lease.epoch];
  held.progress = {.task = lease.task, .epoch = lease.epoch};
  return held.stop.get_token();
}

void HeldLeases::Report(uint64_t epoch, const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const auto it = held_.find(epoch);
  if (it != held_.end()) it->second.progress.progress = progress;
}

void HeldLeases::Remove(uint64_t epoch) {
  const std::lock_guard lock(mutex_);
  held_.erase(epoch);
}

std::vector<LeaseProgress> HeldLeases::List() const {
  const std::lock_guard lock(mutex_);
  std::vector<LeaseProgress> leases;
  for (const auto& [epoch, held] : held_) leases.push_back(held.progress);
  return leases;
}

void HeldLeases::StopTask(const Digest& task) {
  const std::lock_guard lock(mutex_);
  for (auto& [epoch, held] : held_) {
    if (held.progress.task == task) held.stop.request_stop();
  }
}

void HeldLeases::StopAll() {
  const std::lock_guard lock(mutex_);
  for (auto& [epoch, held] : held_) held.stop.request_stop();
}

}  // namespace orbweave
