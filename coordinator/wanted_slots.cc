// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/wanted_slots.h"

#include <algorithm>
#include <utility>

namespace orbweave {

void WantedSlots::Note(uint64_t tasks, double now_s) {
  while (!past_.empty() && past_.front().until_s + kHold_s < now_s) past_.pop_front();
  const uint64_t before = std::exchange(tasks_, tasks);
  while (!past_.empty() && past_.back().tasks <= std::max(before, tasks)) past_.pop_back();
  if (before > tasks) past_.push_back({before, now_s});
}

uint32_t WantedSlots::At(double now_s) const {
  uint64_t most = tasks_;
  for (const Past& past : past_) {
    if (past.until_s + kHold_s < now_s) continue;
    most = past.tasks;
    break;
  }
  return static_cast<uint32_t>(std::min<uint64_t>(most, limit_));
}

}  // namespace orbweave
