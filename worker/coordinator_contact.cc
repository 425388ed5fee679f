// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/coordinator_contact.h"

#include <utility>

namespace orbweave {

void CoordinatorContact::Heard(bool is_busy, double now_s) {
  const std::lock_guard lock(mutex_);
  heard_s_ = now_s;
  if (std::exchange(is_away_, false) || is_busy) busy_s_ = now_s;
}

void CoordinatorContact::NotHeard() {
  const std::lock_guard lock(mutex_);
  is_away_ = true;
}

void CoordinatorContact::Worked(double now_s) {
  const std::lock_guard lock(mutex_);
  busy_s_ = now_s;
}

bool CoordinatorContact::IsGivenUp(double now_s) const {
  const std::lock_guard lock(mutex_);
  return now_s - heard_s_ >= patience_s_;
}

double CoordinatorContact::UntilIdle(double now_s) const {
  const std::lock_guard lock(mutex_);
  return idle_s_ - (now_s - busy_s_);
}

}  // namespace orbweave
