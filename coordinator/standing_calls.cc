// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/standing_calls.h"

#include <chrono>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {

StandingCalls::StandingCalls(std::shared_ptr<RevocationList> revocations)
    : revocations_(std::move(revocations)),
      thread_([this](const std::stop_token& stop) { CallOffTheRevoked(stop); }) {}

std::unique_ptr<StandingCalls::Call> StandingCalls::Begin(Peer peer,
                                                          std::function<void()> call_off) {
  return std::make_unique<Call>(*this, std::move(peer), std::move(call_off));
}

StandingCalls::Call::Call(StandingCalls& calls, Peer peer, std::function<void()> call_off)
    : calls_(calls), peer_(std::move(peer)), call_off_(std::move(call_off)) {
  const std::lock_guard lock(calls_.mutex_);
  place_ = calls_.calls_.insert(calls_.calls_.end(), this);
}

StandingCalls::Call::~Call() {
  const std::lock_guard lock(calls_.mutex_);
  calls_.calls_.erase(place_);
}

absl::Status StandingCalls::Call::Check() const {
  return calls_.revocations_->Check(peer_.identity, peer_.certificate_pem);
}

void StandingCalls::CallOffTheRevoked(const std::stop_token& stop) {
  constexpr auto kLook = std::chrono::seconds(1);
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    woken_.wait_for(lock, stop, kLook, [] { return false; });
    std::map<std::string, bool> may_go_on;  // a peer has many calls
    for (Call* call : calls_) {
      const std::string peer =
          absl::StrCat(call->peer_.identity.ToUri(), "\n", call->peer_.certificate_pem);
      const auto [known, is_new] = may_go_on.try_emplace(peer, true);
      if (is_new) known->second = !absl::IsPermissionDenied(call->Check());
      if (known->second) continue;
      if (const auto call_off = std::exchange(call->call_off_, nullptr)) call_off();
    }
  }
}

}  // namespace orbweave
