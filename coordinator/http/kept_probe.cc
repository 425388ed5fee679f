// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/kept_probe.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {

KeptProbe::KeptProbe(std::function<absl::Status()> probe,
                     const Clock& clock,
                     ProbePatience patience)
    : probe_(std::move(probe)),
      clock_(clock),
      patience_(patience),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

absl::Status KeptProbe::Ask() {
  std::unique_lock lock(mutex_);
  const double now_s = clock_.NowSeconds();
  const bool is_fresh = answered_s_ && now_s - *answered_s_ < patience_.keep_s;
  if (!asked_s_ && is_fresh) return answer_;
  if (!asked_s_) asked_s_ = now_s;
  asked_.notify_one();
  const double away_s = now_s - *asked_s_;
  const std::chrono::duration<double> wait(std::max(0.0, patience_.wait_s - away_s));
  if (answered_.wait_for(lock, wait, [this] { return !asked_s_; })) return answer_;
  return absl::UnavailableError(
      absl::StrCat("the probe has not come back for ", std::ceil(away_s + wait.count()), " s"));
}

void KeptProbe::Run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (asked_.wait(lock, stop, [this] { return asked_s_.has_value(); })) {
    lock.unlock();
    const absl::Status answer = probe_();
    lock.lock();
    answer_ = answer;
    answered_s_ = clock_.NowSeconds();
    asked_s_.reset();
    answered_.notify_all();
  }
}

}  // namespace orbweave
